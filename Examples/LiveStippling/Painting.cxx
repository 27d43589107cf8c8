// SPDX-License-Identifier: BSD-3-Clause
#include "Painting.h"

#include <algorithm>
#include <cmath>

Painting::Painting(int width, int height, float ink)
  : Columns(width)
  , Rows(height)
  , Ink(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
  , ShownInk(this->Ink.size(), ink)
  , Differs(static_cast<std::size_t>(height), Span{ width, 0 })
{
  this->Fill(ink);
}

Painting::Painting(int width, int height, const Painting& previous)
  : Painting(width, height, 0.0f)
{
  for (int y = 0; y < height; ++y)
  {
    const int row = static_cast<int>(static_cast<double>(y) / height * previous.Rows);
    for (int x = 0; x < width; ++x)
    {
      const int column = static_cast<int>(static_cast<double>(x) / width * previous.Columns);
      this->Put(x, y, previous.Painted(column, row));
      this->ShownInk[this->Index(x, y)] = previous.ShownInk[previous.Index(column, row)];
    }
  }
}

void Painting::Stroke(Place from, Place to, double radius, double amount)
{
  const double length = std::hypot(to.X - from.X, to.Y - from.Y);
  const int dabs = 1 + static_cast<int>(length / (0.25 * radius));
  for (int i = 1; i <= dabs; ++i)
  {
    const double part = static_cast<double>(i) / dabs;
    this->Dab({ from.X + part * (to.X - from.X), from.Y + part * (to.Y - from.Y) }, radius, amount);
  }
}

void Painting::Dab(Place centre, double radius, double amount)
{
  const auto cell = [](double x, int count) {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, static_cast<double>(count)));
  };
  const int lastRow = cell(centre.Y + radius + 1.0, this->Rows);
  const int firstColumn = cell(centre.X - radius, this->Columns);
  const int lastColumn = cell(centre.X + radius + 1.0, this->Columns);
  for (int y = cell(centre.Y - radius, this->Rows); y < lastRow; ++y)
  {
    for (int x = firstColumn; x < lastColumn; ++x)
    {
      const double dx = (x + 0.5 - centre.X) / radius;
      const double dy = (y + 0.5 - centre.Y) / radius;
      const double fade = 1.0 - dx * dx - dy * dy;
      if (fade > 0.0)
      {
        this->Put(x, y, this->Painted(x, y) + static_cast<float>(amount * fade * fade));
      }
    }
    this->Touch(y, firstColumn, lastColumn);
  }
}

void Painting::Fill(float ink)
{
  for (int y = 0; y < this->Rows; ++y)
  {
    for (int x = 0; x < this->Columns; ++x)
    {
      this->Put(x, y, ink);
    }
    this->Touch(y, 0, this->Columns);
  }
}

void Painting::Invert()
{
  for (int y = 0; y < this->Rows; ++y)
  {
    for (int x = 0; x < this->Columns; ++x)
    {
      this->Put(x, y, 1.0f - this->Painted(x, y));
    }
    this->Touch(y, 0, this->Columns);
  }
}

void Painting::Set(const std::vector<float>& ink)
{
  for (int y = 0; y < this->Rows; ++y)
  {
    for (int x = 0; x < this->Columns; ++x)
    {
      this->Put(x, y, ink[this->Index(x, y)]);
    }
    this->Touch(y, 0, this->Columns);
  }
}

bool Painting::Follows()
{
  bool changed = false;
  for (int y = 0; y < this->Rows && !this->IsEmpty(); ++y)
  {
    const Span& span = this->Differs[static_cast<std::size_t>(y)];
    changed = (span.Begin < span.End && this->FollowsRow(y)) || changed;
  }
  return changed;
}

bool Painting::FollowsRow(int y)
{
  constexpr float same = 1.0f / 1024.0f;
  Span& span = this->Differs[static_cast<std::size_t>(y)];
  const float* ink = this->Ink.data() + this->Index(0, y);
  float* shown = this->ShownInk.data() + this->Index(0, y);
  float largest = 0.0f;
  for (int x = span.Begin; x < span.End; ++x)
  {
    const float difference = ink[x] - shown[x];
    largest = std::max(largest, std::abs(difference));
    shown[x] += Follow * difference;
  }
  if (largest <= same)
  {
    std::copy(ink + span.Begin, ink + span.End, shown + span.Begin);
    span = { this->Columns, 0 };
  }
  return largest > 0.0f;
}

void Painting::Put(int x, int y, float ink)
{
  float& cell = this->Ink[this->Index(x, y)];
  this->Inked -= cell > 0.0f ? 1 : 0;
  cell = ink > 0.0f ? std::min(ink, 1.0f) : 0.0f; // of NaN, too
  this->Inked += cell > 0.0f ? 1 : 0;
}

void Painting::Touch(int y, int begin, int end)
{
  Span& span = this->Differs[static_cast<std::size_t>(y)];
  span = { std::min(span.Begin, begin), std::max(span.End, end) };
}
