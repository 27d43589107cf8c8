// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkCheckeredSurfaceRepresentation.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkTexture.h"

#include <algorithm>

vtkStandardNewMacro(vtkCheckeredSurfaceRepresentation);

namespace
{

constexpr int squares = 24; // along a side

// A pixel for each square.
vtkSmartPointer<vtkImageData> makeCheckerboard()
{
  constexpr unsigned char light[] = { 255, 255, 255 };
  constexpr unsigned char dark[] = { 140, 150, 165 };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(squares, squares, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < squares; ++y)
  {
    for (int x = 0; x < squares; ++x)
    {
      std::copy_n((x + y) % 2 == 0 ? light : dark, 3,
        static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0)));
    }
  }
  return image;
}

} // namespace

vtkCheckeredSurfaceRepresentation::vtkCheckeredSurfaceRepresentation()
{
  this->Checkerboard->SetInputData(makeCheckerboard());
  this->vtkCheckeredSurfaceRepresentation::SetTexture(nullptr);
}

vtkCheckeredSurfaceRepresentation::~vtkCheckeredSurfaceRepresentation() = default;

void vtkCheckeredSurfaceRepresentation::SetTexture(vtkTexture* texture)
{
  this->Superclass::SetTexture(texture ? texture : this->Checkerboard);
}
