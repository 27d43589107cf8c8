// SPDX-License-Identifier: BSD-3-Clause
// Densities that are read from Testing/Data, photographs, as ink or as light, and a brain; and the
// list of all densities on which areas and masses are measured.
#ifndef RectifiedTransport_AreaPhotographs_h
#define RectifiedTransport_AreaPhotographs_h

#include "../Core/TestDensities.h"
#include "AreaSuite.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

// raccoon (1024 x 768), ascent (512 x 512) or night-europe (342 x 182); as ink, dark is mass. The
// means of blocks of `reduction`^2 pixels are the cells.
inline TestDensity<2> photographDensity(
  const std::string& name, bool ink = true, std::int64_t reduction = 1)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((RECTIFIEDTRANSPORT_DATA "/" + name + ".png").c_str());
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  if (!pixels)
  {
    throw std::runtime_error("cannot read " + name + ".png");
  }
  const int* points = reader->GetOutput()->GetDimensions();
  TestDensity<2> density = uniformDensity<2>({ points[0] / reduction, points[1] / reduction }, 0.0);
  for (std::size_t cell = 0; cell < density.Values.size(); ++cell)
  {
    const GridSize<2> at = cellAt<2>(static_cast<std::int64_t>(cell), density.Size);
    for (std::int64_t y = reduction * at[1]; y < reduction * (at[1] + 1); ++y)
    {
      for (std::int64_t x = reduction * at[0]; x < reduction * (at[0] + 1); ++x)
      {
        const vtkIdType pixel = y * points[0] + x;
        const double light = pixels->GetNumberOfComponents() < 3
          ? pixels->GetComponent(pixel, 0)
          : 0.2126 * pixels->GetComponent(pixel, 0) + 0.7152 * pixels->GetComponent(pixel, 1) +
            0.0722 * pixels->GetComponent(pixel, 2);
        density.Values[cell] += ink ? 255.0 - light : light;
      }
    }
  }
  return density;
}

// Magnetic resonance of a head, 90 x 108 x 90, with a part of its mean added to every cell.
inline TestDensity<3> brainDensity(double partOfMean)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(RECTIFIEDTRANSPORT_DATA "/brain-t1.vti");
  reader->Update();
  vtkDataArray* values = reader->GetOutput()->GetPointData()->GetScalars();
  if (!values)
  {
    throw std::runtime_error("cannot read brain-t1.vti");
  }
  const int* points = reader->GetOutput()->GetDimensions();
  TestDensity<3> density = uniformDensity<3>({ points[0], points[1], points[2] }, 0.0);
  double sum = 0.0;
  for (std::size_t cell = 0; cell < density.Values.size(); ++cell)
  {
    density.Values[cell] = values->GetComponent(static_cast<vtkIdType>(cell), 0);
    sum += density.Values[cell];
  }
  const double added = partOfMean * sum / static_cast<double>(density.Values.size());
  std::for_each(
    density.Values.begin(), density.Values.end(), [added](double& value) { value += added; });
  return density;
}

// add(name, function that makes the density), of each dimension.
template <class Add>
void forAreaDensities(const Add& add)
{
  const auto add2D = [&add](const std::string& name, std::function<TestDensity<2>()> make) {
    add(name, std::move(make));
  };
  add2D("raccoon", []() { return photographDensity("raccoon"); });
  add2D("raccoon-4", []() { return photographDensity("raccoon", true, 4); });
  add2D("ascent", []() { return photographDensity("ascent"); });
  add2D("night-europe", []() { return photographDensity("night-europe"); });
  for (const std::string name : { "gauss", "gausses", "peak", "circle", "disc01", "star01",
         "disc10", "disc100", "disc1000", "square10", "square100", "square1000", "checker3",
         "checker10", "clumps", "noise", "noise3", "noiselog" })
  {
    add2D(name, [name]() { return areaDensity2D(name, { 256, 256 }); });
  }
  const auto add3D = [&add](const std::string& name, std::function<TestDensity<3>()> make) {
    add(name, std::move(make));
  };
  for (const std::string name : { "ball10", "ball100", "clumps" })
  {
    add3D(name + "-3d", [name]() { return areaDensity3D(name, { 64, 64, 64 }); });
  }
  add3D("brain", []() { return brainDensity(0.05); });
}

} // namespace RectifiedTransport

#endif
