// SPDX-License-Identifier: BSD-3-Clause
#include "ReadInk.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkImageResize.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace
{

constexpr int shortestSide = 16; // of a picture that is all but a line

// The reader of TGA of VTK 9.6 also takes folders and texts, and ends the program then.
bool takesAnything(vtkImageReader2* reader, const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  return reader->IsA("vtkTGAReader") && extension != ".tga" && extension != ".TGA";
}

vtkSmartPointer<vtkImageData> readImage(const std::string& path)
{
  const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(path.c_str()));
  if (!reader || takesAnything(reader, path))
  {
    return nullptr;
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const bool whole = reader->GetErrorCode() == 0 && image->GetNumberOfPoints() > 0 &&
    image->GetPointData()->GetScalars() != nullptr && image->GetDimensions()[2] == 1;
  return whole ? image : nullptr;
}

vtkSmartPointer<vtkImageData> resize(vtkImageData* image, int width, int height)
{
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(image);
  resize->SetOutputDimensions(width, height, 1);
  resize->BorderOn(); // pixels are areas
  resize->Update();
  return resize->GetOutput();
}

// Rec. 709, exactly 0 for white; over white where there is alpha.
double inkOf(const std::vector<double>& pixel, double white)
{
  const auto dark = [&](std::size_t component) { return 1.0 - pixel[component] / white; };
  const std::size_t colours = pixel.size() < 3 ? 1 : 3;
  const double ink =
    colours == 1 ? dark(0) : 0.2126 * dark(0) + 0.7152 * dark(1) + 0.0722 * dark(2);
  return pixel.size() == colours + 1 ? ink * pixel.back() / white : ink;
}

} // namespace

bool readInk(const std::string& path, int side, Ink& ink, std::string& error)
{
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff(); // one sentence tells of a file that no reader takes
  const vtkSmartPointer<vtkImageData> image = readImage(path);
  vtkObject::SetGlobalWarningDisplay(warnings);
  if (!image)
  {
    error = path + " holds no picture that can be read";
    return false;
  }
  const int* size = image->GetDimensions();
  const double scale = static_cast<double>(side) / std::max(size[0], size[1]);
  const auto resized = [&](int count) {
    return std::max(shortestSide, static_cast<int>(std::lround(scale * count)));
  };
  ink.Width = resized(size[0]);
  ink.Height = resized(size[1]);
  vtkDataArray* original = image->GetPointData()->GetScalars();
  const double white =
    original->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : original->GetRange(-1)[1];
  const vtkSmartPointer<vtkImageData> cells = resize(image, ink.Width, ink.Height);
  vtkDataArray* values = cells->GetPointData()->GetScalars();
  std::vector<double> pixel(static_cast<std::size_t>(values->GetNumberOfComponents()));
  ink.Values.resize(static_cast<std::size_t>(values->GetNumberOfTuples()));
  for (std::size_t i = 0; i < ink.Values.size(); ++i)
  {
    values->GetTuple(static_cast<vtkIdType>(i), pixel.data());
    ink.Values[i] =
      white > 0.0 ? static_cast<float>(std::clamp(inkOf(pixel, white), 0.0, 1.0)) : 1.0f;
  }
  return true;
}
