// SPDX-License-Identifier: BSD-3-Clause
#include "LiveTransport.h"

#include "vtkTransportSampler.h"
#include "vtkUniformSeedSource.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstddef>

namespace
{

// Even points of a box of this size.
Points evenPoints(const double size[2], int count)
{
  vtkNew<vtkUniformSeedSource> source;
  source->SetBounds(0.0, size[0], 0.0, size[1], 0.0, 0.0);
  source->SetNumberOfPoints(count);
  source->Update();
  Points points(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    source->GetOutput()->GetPoint(i, points[static_cast<std::size_t>(i)].data());
  }
  return points;
}

} // namespace

LiveTransport::LiveTransport(Painting& painting, int numberOfPoints)
{
  this->Ids->SetName("PointId");
  this->SeedPoints->SetDataTypeToDouble();
  this->Seeds->SetPoints(this->SeedPoints);
  this->Seeds->GetPointData()->AddArray(this->Ids);
  this->Sampler->SetInputData(this->Density);
  this->Sampler->SetSeedsData(this->Seeds);
  // The tables serve one update: a flow map, too, would have to pay for itself at once.
  this->Sampler->SetFlowMapsToOff();
  const auto keep = [this](unsigned long event, std::string& kept) {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&kept);
    command->SetCallback([](vtkObject*, unsigned long, void* to, void* text) {
      *static_cast<std::string*>(to) = static_cast<const char*>(text);
    });
    this->Sampler->AddObserver(event, command);
  };
  keep(vtkCommand::ErrorEvent, this->Error);
  keep(vtkCommand::WarningEvent, this->Warning);
  this->Targets.resize(static_cast<std::size_t>(std::clamp(numberOfPoints, 1, MostPoints)));
  this->SetPainting(painting);
}

LiveTransport::~LiveTransport() = default;

void LiveTransport::UseDevice(const std::string& name)
{
  this->Sampler->SetDeviceToOpenCL();
  this->Sampler->SetDeviceName(name.c_str());
}

void LiveTransport::SetPainting(Painting& painting)
{
  const double scale[2] = { painting.Width() / this->Size[0], painting.Height() / this->Size[1] };
  for (auto& seed : this->Now)
  {
    seed = { seed[0] * scale[0], seed[1] * scale[1], 0.0 };
  }
  this->Size[0] = painting.Width();
  this->Size[1] = painting.Height();
  const int size[2] = { painting.Width(), painting.Height() };
  vtkNew<vtkFloatArray> ink;
  ink->SetName("Ink");
  ink->SetArray(painting.Shown(), static_cast<vtkIdType>(size[0]) * size[1], 1); // no copy
  this->Density->SetDimensions(size[0] + 1, size[1] + 1, 1);
  this->Density->GetCellData()->SetScalars(ink);
  this->Rearrange(this->GetNumberOfPoints());
}

void LiveTransport::SetNumberOfPoints(int count)
{
  count = std::clamp(count, 1, MostPoints);
  if (count != this->GetNumberOfPoints())
  {
    this->Rearrange(count);
  }
}

void LiveTransport::Rearrange(int count)
{
  const Points to = evenPoints(this->Size, count);
  const std::vector<int> partners = pairPoints(this->Now, to);
  std::vector<bool> taken(to.size(), false);
  std::vector<vtkIdType> ids;
  this->Starts.clear();
  this->Targets.clear();
  for (std::size_t i = 0; i < this->Now.size(); ++i)
  {
    if (partners[i] >= 0)
    {
      const auto partner = static_cast<std::size_t>(partners[i]);
      taken[partner] = true;
      this->Starts.push_back(this->Now[i]);
      this->Targets.push_back(to[partner]);
      ids.push_back(this->Ids->GetValue(static_cast<vtkIdType>(i)));
    }
  }
  for (std::size_t j = 0; j < to.size(); ++j)
  {
    if (!taken[j])
    {
      this->Starts.push_back(to[j]);
      this->Targets.push_back(to[j]);
      ids.push_back(static_cast<vtkIdType>(this->NextId++));
    }
  }
  this->Ids->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), this->Ids->GetPointer(0));
  this->Ids->Modified();
  this->Now = this->Starts;
  this->WriteSeeds();
  this->Gliding = GlideUpdates;
}

void LiveTransport::Glide()
{
  if (this->Gliding == 0)
  {
    return;
  }
  this->Gliding -= 1;
  const double part = 1.0 - static_cast<double>(this->Gliding) / GlideUpdates;
  const double smooth = part * part * (3.0 - 2.0 * part);
  for (std::size_t i = 0; i < this->Starts.size(); ++i)
  {
    const auto& start = this->Starts[i];
    const auto& target = this->Targets[i];
    this->Now[i] = { start[0] + smooth * (target[0] - start[0]),
      start[1] + smooth * (target[1] - start[1]), 0.0 };
  }
  this->WriteSeeds();
}

void LiveTransport::WriteSeeds()
{
  this->SeedPoints->SetNumberOfPoints(static_cast<vtkIdType>(this->Now.size()));
  for (std::size_t i = 0; i < this->Now.size(); ++i)
  {
    this->SeedPoints->SetPoint(static_cast<vtkIdType>(i), this->Now[i].data());
  }
  this->SeedPoints->Modified();
}

bool LiveTransport::Update(bool changed)
{
  if (!changed && this->Gliding == 0)
  {
    return false;
  }
  this->Glide();
  if (changed)
  {
    this->Density->GetCellData()->GetScalars()->Modified();
  }
  this->Error.clear();
  this->Warning.clear();
  this->Sampler->Update();
  // That particles of empty cells went to the nearest ink is no news for one who paints.
  if (this->Warning.find("the processor did the work") != std::string::npos)
  {
    this->Sampler->SetDeviceToCPU();
    this->Error = this->Warning;
  }
  return true;
}

vtkPolyData* LiveTransport::GetOutput()
{
  return this->Sampler->GetOutput();
}
