// SPDX-License-Identifier: BSD-3-Clause
// The library from outside: the same particles from a filter in a VTK pipeline and from the
// mathematics without VTK.
#include <RectifiedTransport/Core/Flow/RectifiedFlow.h>
#include <RectifiedTransport/Core/Seeds/Seeds.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransportSampler.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace RectifiedTransport;

int main()
{
  const int width = 64;
  const int height = 48;
  const int count = 1000;
  vtkNew<vtkImageData> image;
  image->SetDimensions(width + 1, height + 1, 1);
  std::vector<double> hill;
  vtkNew<vtkDoubleArray> array;
  array->SetName("Hill");
  for (int i = 0; i < width * height; ++i)
  {
    const double distance = std::hypot(i % width - width / 2, i / width - height / 2);
    hill.push_back(std::exp(-distance / 8));
    array->InsertNextValue(hill.back());
  }
  image->GetCellData()->SetScalars(array);

  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(count);
  sampler->Update();

  std::vector<Point<2>> seeds(count);
  generateSeeds<2>(SeedPattern::BlueNoise, { width, height }, 1, seeds);
  for (Point<2>& seed : seeds)
  {
    seed = { seed[0] * width, seed[1] * height };
  }
  const DensityArray<2, double> density(hill.data(), { width, height });
  const std::vector<Point<2>> particles = transportPoints<2>(density, seeds);

  double difference = sampler->GetOutput()->GetNumberOfPoints() == count ? 0 : HUGE_VAL;
  for (int i = 0; i < count && difference < HUGE_VAL; ++i)
  {
    const double* point = sampler->GetOutput()->GetPoint(i);
    const Point<2>& particle = particles[static_cast<std::size_t>(i)];
    difference = std::max(difference, std::hypot(point[0] - particle[0], point[1] - particle[1]));
  }
  std::cout << count << " particles, the two ways differ by " << difference << "\n";
  return difference < 1e-9 ? EXIT_SUCCESS : EXIT_FAILURE;
}
