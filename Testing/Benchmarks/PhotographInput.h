// SPDX-License-Identifier: BSD-3-Clause
// The photograph of the stippling job and its seeds.
#ifndef RectifiedTransport_PhotographInput_h
#define RectifiedTransport_PhotographInput_h

#include "BenchmarkInputs.h"

#include "Core/Seeds/Seeds.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <stdexcept>

namespace RectifiedTransport
{

constexpr std::int64_t PhotographSide = 1024;
constexpr std::int64_t PhotographParticles = 40000;

// raccoon.png, 1024 x 768 in colour, its last 256 rows mirrored below. Dark is mass.
class Photograph
{
public:
  static const Photograph& Instance()
  {
    static const Photograph photograph;
    return photograph;
  }

  vtkNew<vtkImageData> Image;
  TestDensity<2> Density;
  Particles<2> Seeds;

private:
  Photograph()
  {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(RECTIFIEDTRANSPORT_DATA "/raccoon.png");
    reader->Update();
    vtkImageData* picture = reader->GetOutput();
    auto* pixels = vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetScalars());
    if (!pixels || picture->GetDimensions()[0] != PhotographSide ||
      pixels->GetNumberOfComponents() != 3)
    {
      throw std::runtime_error("raccoon.png is not what the benchmark expects");
    }
    const std::int64_t rows = picture->GetDimensions()[1];
    this->Image->SetDimensions(PhotographSide, PhotographSide, 1);
    this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* values = vtkUnsignedCharArray::SafeDownCast(this->Image->GetPointData()->GetScalars());
    this->Density = uniformDensity<2>({ PhotographSide, PhotographSide });
    for (std::int64_t y = 0; y < PhotographSide; ++y)
    {
      const std::int64_t from =
        y + rows >= PhotographSide ? y + rows - PhotographSide : PhotographSide - rows - 1 - y;
      for (std::int64_t x = 0; x < PhotographSide; ++x)
      {
        const unsigned char* pixel = pixels->GetPointer(3 * (from * PhotographSide + x));
        std::copy_n(pixel, 3, values->GetPointer(3 * (y * PhotographSide + x)));
        this->Density.Values[y * PhotographSide + x] =
          255.0 - (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]);
      }
    }
    this->Seeds.resize(PhotographParticles);
    generateSeeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, 1, this->Seeds);
    for (Point<2>& seed : this->Seeds)
    {
      seed = { PhotographSide * seed[0], PhotographSide * seed[1] };
    }
  }
};

} // namespace RectifiedTransport

#endif
