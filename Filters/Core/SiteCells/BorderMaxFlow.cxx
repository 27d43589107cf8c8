// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/BorderMaxFlow.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t unreached = std::numeric_limits<std::int64_t>::max() - 1;

} // namespace

void BorderMaxFlow::Clear()
{
  this->Contacts.clear();
  this->Numbers.clear();
}

std::int64_t BorderMaxFlow::Add(std::int64_t low, std::int64_t high)
{
  const auto next = static_cast<std::int64_t>(this->Contacts.size());
  const auto [found, isNew] = this->Numbers.try_emplace(this->Key(low, high), next);
  if (isNew)
  {
    this->Contacts.push_back({ low, high });
  }
  return found->second;
}

std::int64_t BorderMaxFlow::Find(std::int64_t low, std::int64_t high) const
{
  return this->Numbers.find(this->Key(low, high))->second;
}

void BorderMaxFlow::Plan(const std::vector<std::int64_t>& excess,
  const std::vector<std::int64_t>& count, Progress& progress)
{
  this->FindNeighbours();
  this->Open = excess;
  this->Left = count;
  while (this->CountSteps())
  {
    this->Next.assign(this->FirstNeighbour.begin(), this->FirstNeighbour.end() - 1);
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      if (this->Open[cell] > 0 && this->Steps[cell] != unreached)
      {
        progress.Check();
      }
      while (this->Open[cell] > 0 && this->FindWay(cell))
      {
        this->Send(cell);
      }
    }
  }
  progress.Check();
}

void BorderMaxFlow::FindNeighbours()
{
  this->FirstNeighbour.assign(static_cast<std::size_t>(this->Cells) + 1, 0);
  for (const SiteCellBorder& contact : this->Contacts)
  {
    ++this->FirstNeighbour[contact.Low + 1];
    ++this->FirstNeighbour[contact.High + 1];
  }
  std::partial_sum(
    this->FirstNeighbour.begin(), this->FirstNeighbour.end(), this->FirstNeighbour.begin());
  this->Neighbours.resize(2 * this->Contacts.size());
  this->Next = this->FirstNeighbour;
  for (std::size_t i = 0; i < this->Contacts.size(); ++i)
  {
    const SiteCellBorder& contact = this->Contacts[i];
    const auto number = static_cast<std::int64_t>(i);
    this->Neighbours[this->Next[contact.Low]++] = { contact.High, number, 1 };
    this->Neighbours[this->Next[contact.High]++] = { contact.Low, number, -1 };
  }
}

// How much more may flow.
std::int64_t BorderMaxFlow::Capacity(std::int64_t number, int sign) const
{
  const SiteCellBorder& contact = this->Contacts[number];
  return std::max<std::int64_t>(1, contact.Faces / 2) - sign * contact.Flow;
}

// The number of steps from each cell to the nearest one that has too few. False if there is no way
// from one that has too many.
bool BorderMaxFlow::CountSteps()
{
  this->Steps.assign(static_cast<std::size_t>(this->Cells), unreached);
  this->Queue.clear();
  for (std::int64_t cell = 0; cell < this->Cells; ++cell)
  {
    if (this->Open[cell] < 0)
    {
      this->Steps[cell] = 0;
      this->Queue.push_back(cell);
    }
  }
  bool found = false;
  for (std::size_t at = 0; at < this->Queue.size(); ++at)
  {
    const std::int64_t cell = this->Queue[at];
    found = found || this->Open[cell] > 0;
    for (std::int64_t i = this->FirstNeighbour[cell]; i < this->FirstNeighbour[cell + 1]; ++i)
    {
      const Neighbour& from = this->Neighbours[i];
      if (this->Steps[from.Cell] == unreached && this->Left[from.Cell] > 0 &&
        this->Capacity(from.Contact, -from.Sign) > 0)
      {
        this->Steps[from.Cell] = this->Steps[cell] + 1;
        this->Queue.push_back(from.Cell);
      }
    }
  }
  return found;
}

// A shortest way to a cell that has too few, which ends there. No neighbour that was of no use is
// tried again.
bool BorderMaxFlow::FindWay(std::int64_t start)
{
  this->Way.clear();
  std::int64_t cell = start;
  while (this->Open[cell] >= 0)
  {
    std::int64_t& next = this->Next[cell];
    const std::int64_t end = this->FirstNeighbour[cell + 1];
    while (next < end && !this->LeadsOn(cell, this->Neighbours[next]))
    {
      ++next;
    }
    if (next < end)
    {
      this->Way.push_back(next);
      cell = this->Neighbours[next].Cell;
    }
    else if (this->Way.empty())
    {
      return false;
    }
    else
    {
      const std::int64_t last = this->Way.back();
      this->Way.pop_back();
      cell = this->Way.empty() ? start : this->Neighbours[this->Way.back()].Cell;
      this->Next[cell] = last + 1;
    }
  }
  return true;
}

bool BorderMaxFlow::LeadsOn(std::int64_t cell, const Neighbour& to) const
{
  return this->Steps[to.Cell] + 1 == this->Steps[cell] && this->Left[cell] > 0 &&
    this->Capacity(to.Contact, to.Sign) > 0;
}

void BorderMaxFlow::Send(std::int64_t start)
{
  std::int64_t amount = this->Open[start];
  std::int64_t cell = start;
  for (const std::int64_t step : this->Way)
  {
    const Neighbour& to = this->Neighbours[step];
    amount = std::min({ amount, this->Left[cell], this->Capacity(to.Contact, to.Sign) });
    cell = to.Cell;
  }
  amount = std::min(amount, -this->Open[cell]);
  this->Open[start] -= amount;
  this->Open[cell] += amount;
  cell = start;
  for (const std::int64_t step : this->Way)
  {
    const Neighbour& to = this->Neighbours[step];
    this->Contacts[to.Contact].Flow += to.Sign * amount;
    this->Left[cell] -= amount;
    cell = to.Cell;
  }
}

} // namespace RectifiedTransport
