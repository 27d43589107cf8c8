// SPDX-License-Identifier: BSD-3-Clause
#include "Drive.h"

#include "Stippling.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <string>
#include <unordered_map>
#include <vector>

namespace
{

constexpr int clicks = 4; // of the wheel

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// How far points move between updates: a point is known by its PointId.
class Motion
{
public:
  void Observe(vtkPolyData* points)
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(points->GetPointData()->GetArray("PointId"));
    std::unordered_map<vtkIdType, std::array<double, 2>> places;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      const double* point = points->GetPoint(i);
      const std::array<double, 2> place{ point[0], point[1] };
      const auto before = this->Places.find(ids->GetValue(i));
      if (before != this->Places.end())
      {
        const auto& old = before->second;
        this->Largest = std::max(this->Largest, std::hypot(place[0] - old[0], place[1] - old[1]));
        this->Known += 1;
      }
      places.emplace(ids->GetValue(i), place);
    }
    this->Gone += static_cast<long long>(this->Places.size()) - this->Known;
    this->Known = 0;
    this->Places.swap(places);
  }
  void BeginPhase()
  {
    this->Largest = 0.0;
    this->Gone = 0;
  }
  double LargestStep() const { return this->Largest; }
  long long Vanished() const { return this->Gone; }

private:
  std::unordered_map<vtkIdType, std::array<double, 2>> Places;
  double Largest = 0.0;
  long long Known = 0;
  long long Gone = 0;
};

class Driver
{
public:
  Driver(Stippling& stippling, vtkRenderWindowInteractor* interactor, std::ostream& out)
    : Model(stippling)
    , Interactor(interactor)
    , Out(out)
  {
  }

  // Lets the opened picture appear.
  void Settle()
  {
    for (int i = 0; i < 60; ++i)
    {
      this->Update();
    }
  }

  // `act` gets the number of the update, from 1 on, and the part of the phase that has then passed.
  template <class Act>
  void Phase(const char* name, int updates, const Act& act)
  {
    this->Computed.clear();
    this->Drawn.clear();
    this->Moves.BeginPhase();
    for (int i = 1; i <= updates; ++i)
    {
      act(i, static_cast<double>(i) / updates);
      this->Update();
    }
    this->Report(name);
  }

  void Send(unsigned long event) { this->Interactor->InvokeEvent(event); }

  // In parts of the window's sides.
  void MoveTo(double x, double y)
  {
    const int* size = this->Interactor->GetRenderWindow()->GetSize();
    this->Interactor->SetEventInformation(
      static_cast<int>(x * size[0]), static_cast<int>(y * size[1]));
    this->Send(vtkCommand::MouseMoveEvent);
  }

private:
  void Update()
  {
    const int moving = this->Model.GetMovingUpdates();
    const Clock::time_point start = Clock::now();
    this->Send(vtkCommand::TimerEvent);
    this->Interactor->GetRenderWindow()->WaitForCompletion();
    if (this->Model.GetMovingUpdates() == moving)
    {
      return; // the points have come to rest
    }
    this->Drawn.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    this->Computed.push_back(this->Model.GetUpdateSeconds());
    this->Moves.Observe(this->Model.GetTransport().GetOutput());
  }

  void Report(const char* name)
  {
    const auto rate = [](const std::vector<double>& seconds) { return 1.0 / median(seconds); };
    this->Out << "  " << std::left << std::setw(14) << name << std::right << std::fixed
              << std::setw(8) << this->Computed.size() << std::setprecision(0) << std::setw(10)
              << rate(this->Computed) << std::setw(14) << rate(this->Drawn) << std::setw(10)
              << this->Model.GetTransport().GetNumberOfPoints() << std::setw(10)
              << this->Moves.Vanished() << std::setprecision(2) << std::setw(20)
              << this->Moves.LargestStep() << "\n";
  }

  Stippling& Model;
  vtkRenderWindowInteractor* Interactor;
  std::ostream& Out;
  std::vector<double> Computed; // seconds of the phase's updates
  std::vector<double> Drawn;
  Motion Moves;
};

} // namespace

void drive(
  Stippling& stippling, vtkRenderWindowInteractor* interactor, int updates, std::ostream& out)
{
  Driver driver(stippling, interactor, out);
  driver.Settle();
  Painting& painting = stippling.GetPainting();
  out << "Updates a second (medians), on " << painting.Width() << " x " << painting.Height()
      << " cells:\n"
      << "  phase          updates  computed  with drawing    points  vanished  largest step, "
         "cells\n";
  const int share = std::max(1, updates / 5);
  driver.MoveTo(0.7, 0.75);
  driver.Send(vtkCommand::LeftButtonPressEvent);
  driver.Phase("adding ink", 2 * share, [&](int, double part) {
    const double angle = vtkMath::Pi() * (0.2 + 2.6 * part);
    driver.MoveTo(0.5 + 0.24 * std::sin(angle + 0.5 * vtkMath::Pi()), 0.78 - 0.56 * part);
  });
  driver.Send(vtkCommand::LeftButtonReleaseEvent);
  driver.Phase("more points", share, [&](int update, double) {
    if (update <= clicks)
    {
      driver.Send(vtkCommand::MouseWheelForwardEvent);
    }
  });
  driver.MoveTo(0.15, 0.2);
  driver.Send(vtkCommand::RightButtonPressEvent);
  driver.Phase("removing ink", share,
    [&](int, double part) { driver.MoveTo(0.15 + 0.7 * part, 0.2 + 0.1 * std::sin(6.0 * part)); });
  driver.Send(vtkCommand::RightButtonReleaseEvent);
  driver.Phase("fewer points", share, [&](int update, double) {
    if (update <= clicks)
    {
      driver.Send(vtkCommand::MouseWheelBackwardEvent);
    }
  });
}
