// SPDX-License-Identifier: BSD-3-Clause
// Draws a photograph with dots. usage: StippleImage IMAGE OUTPUT.png [NUMBER-OF-DOTS]
#include "vtkTransportSampler.h"

#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkMath.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    argc < 3 ? nullptr : vtkImageReader2Factory::CreateImageReader2(argv[1]));
  if (!reader)
  {
    std::cerr << "usage: StippleImage IMAGE OUTPUT.png [NUMBER-OF-DOTS]\n";
    return 1;
  }
  reader->SetFileName(argv[1]);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputConnection(reader->GetOutputPort());
  sampler->InvertDensityOn(); // dark ink is mass
  sampler->SetNumberOfParticles(argc > 3 ? std::strtoll(argv[3], nullptr, 10) : 40000);
  sampler->Update();
  vtkPolyData* dots = sampler->GetOutput();
  const int zoom = 3;
  const int* size = reader->GetOutput()->GetDimensions();
  const double black = reader->GetOutput()->GetScalarTypeMax();
  vtkNew<vtkImageData> paper;
  paper->SetDimensions(zoom * size[0], zoom * size[1], 1);
  paper->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  paper->GetPointData()->GetScalars()->Fill(255);
  for (vtkIdType i = 0; i < dots->GetNumberOfPoints(); ++i)
  {
    // A dot's area is its share of the photograph's ink.
    const double ink = dots->GetPointData()->GetArray("Mass")->GetTuple1(i) / black;
    const double radius = zoom * std::sqrt(ink / vtkMath::Pi());
    const double x = zoom * (dots->GetPoint(i)[0] + 0.5), y = zoom * (dots->GetPoint(i)[1] + 0.5);
    for (int k = 0, side = int(2 * radius) + 3; k < side * side; ++k)
    {
      const int u = int(x - radius) - 1 + k % side, v = int(y - radius) - 1 + k / side;
      const double light = std::max(0.0, std::hypot(u + 0.5 - x, v + 0.5 - y) - radius + 0.5);
      if (u >= 0 && v >= 0 && u < zoom * size[0] && v < zoom * size[1] && light < 1)
      {
        auto pixel = static_cast<unsigned char*>(paper->GetScalarPointer(u, v, 0));
        *pixel = std::min(*pixel, static_cast<unsigned char>(255 * light));
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(argv[2]);
  writer->SetInputData(paper);
  writer->Write();
  return dots->GetNumberOfPoints() == 0 || writer->GetErrorCode() != 0;
}
