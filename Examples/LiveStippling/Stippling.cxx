// SPDX-License-Identifier: BSD-3-Clause
#include "Stippling.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{

constexpr double dabInk = 0.08; // of one dab at its centre

} // namespace

Stippling::Stippling(const Options& options)
  : Initial(options)
  , Canvas(std::make_unique<Painting>(options.Side, options.Side, options.Wash))
  , Transport(std::make_unique<LiveTransport>(*this->Canvas, options.NumberOfPoints))
{
  if (!options.Device.empty())
  {
    this->Transport->UseDevice(options.Device == "any" ? "" : options.Device);
  }
}

bool Stippling::Open(const std::string& path)
{
  Ink ink;
  if (!readInk(path, this->Initial.Side, ink, this->Message))
  {
    return false;
  }
  this->Message.clear();
  this->Picture = std::move(ink);
  this->LiftBrush();
  if (this->Picture.Width != this->Canvas->Width() ||
    this->Picture.Height != this->Canvas->Height())
  {
    auto canvas =
      std::make_unique<Painting>(this->Picture.Width, this->Picture.Height, *this->Canvas);
    this->Transport->SetPainting(*canvas);
    this->Canvas = std::move(canvas);
    this->CanvasNumber += 1;
  }
  this->StartOver();
  return true;
}

void Stippling::StartOver()
{
  if (this->Picture.Values.empty())
  {
    this->Canvas->Fill(this->Initial.Wash);
  }
  else
  {
    this->Canvas->Set(this->Picture.Values);
  }
}

void Stippling::Clear()
{
  this->Canvas->Fill(0.0f);
}

void Stippling::Invert()
{
  this->Canvas->Invert();
}

void Stippling::SetNumberOfPoints(double count)
{
  const double most = LiveTransport::MostPoints;
  this->Message = count > most
    ? "There are at most " + std::to_string(LiveTransport::MostPoints) + " points"
    : "";
  this->Transport->SetNumberOfPoints(static_cast<int>(std::clamp(std::round(count), 1.0, most)));
}

void Stippling::ScaleNumberOfPoints(double factor)
{
  const double count = this->Transport->GetNumberOfPoints();
  const double scaled = factor * count;
  this->SetNumberOfPoints(
    factor > 1.0 ? std::max(scaled, count + 1.0) : std::min(scaled, count - 1.0));
}

void Stippling::ScaleBrush(double factor)
{
  this->BrushRadius = std::clamp(factor * this->BrushRadius, 3.0, 0.5 * this->Initial.Side);
}

void Stippling::Paint(Place place, bool removes)
{
  const Place from = this->IsDown ? this->Brush : place;
  this->Canvas->Stroke(from, place, this->BrushRadius, removes ? -dabInk : dabInk);
  this->Brush = place;
  this->IsDown = true;
}

bool Stippling::Update()
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const bool moved = this->Transport->Update(this->Canvas->Follows());
  this->UpdateSeconds = std::chrono::duration<double>(Clock::now() - start).count();
  this->MovingUpdates += moved ? 1 : 0;
  const std::string empty = "Nothing is painted: the points stay where they are";
  if (!this->Transport->GetError().empty())
  {
    this->Message = this->Transport->GetError();
  }
  else if (this->Canvas->IsEmpty())
  {
    this->Message = empty;
  }
  else if (this->Message == empty)
  {
    this->Message.clear();
  }
  return moved;
}
