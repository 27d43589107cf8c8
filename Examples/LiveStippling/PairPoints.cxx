// SPDX-License-Identifier: BSD-3-Clause
#include "PairPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>

namespace
{

struct Candidate
{
  double Square; // of the distance
  int From;
  int To;

  bool operator<(const Candidate& other) const
  {
    return std::tie(this->Square, this->From, this->To) <
      std::tie(other.Square, other.From, other.To);
  }
};

struct Box
{
  double Low[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::max() };
  double High[2] = { std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest() };

  void Add(const Points& points)
  {
    for (const auto& point : points)
    {
      for (std::size_t a = 0; a < 2; ++a)
      {
        this->Low[a] = std::min(this->Low[a], point[a]);
        this->High[a] = std::max(this->High[a], point[a]);
      }
    }
  }
  double Side(int a) const { return std::max(this->High[a] - this->Low[a], 0.0); }
};

// Some of the points, in square bins.
class Bins
{
public:
  Bins(const Points& points, const std::vector<int>& members, const Box& box, double side)
    : Corner{ box.Low[0], box.Low[1] }
    , Side(side)
    , Count{ 1 + static_cast<int>(box.Side(0) / side), 1 + static_cast<int>(box.Side(1) / side) }
    , Members(static_cast<std::size_t>(this->Count[0]) * static_cast<std::size_t>(this->Count[1]))
  {
    for (const int member : members)
    {
      const auto& point = points[static_cast<std::size_t>(member)];
      this->Members[this->Index(this->Bin(point, 0), this->Bin(point, 1))].push_back(member);
    }
  }

  // Visits all that are less than a bin's side away, and others.
  template <class Visit>
  void VisitNear(const std::array<double, 3>& point, const Visit& visit) const
  {
    const int x = this->Bin(point, 0);
    const int y = this->Bin(point, 1);
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, this->Count[1] - 1); ++j)
    {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, this->Count[0] - 1); ++i)
      {
        const auto& members = this->Members[this->Index(i, j)];
        std::for_each(members.begin(), members.end(), visit);
      }
    }
  }

private:
  int Bin(const std::array<double, 3>& point, int a) const
  {
    const double place = (point[static_cast<std::size_t>(a)] - this->Corner[a]) / this->Side;
    return std::clamp(static_cast<int>(place), 0, this->Count[a] - 1);
  }
  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Count[0]) +
      static_cast<std::size_t>(x);
  }

  double Corner[2];
  double Side;
  int Count[2];
  std::vector<std::vector<int>> Members;
};

} // namespace

std::vector<int> pairPoints(const Points& from, const Points& to)
{
  std::vector<int> partner(from.size(), -1);
  std::vector<bool> taken(to.size(), false);
  std::vector<int> free(from.size());
  std::vector<int> left(to.size());
  std::iota(free.begin(), free.end(), 0);
  std::iota(left.begin(), left.end(), 0);
  Box box;
  box.Add(from);
  box.Add(to);
  // Mostly one is found at the distance of neighbours; few are left for the long ways.
  const double area = box.Side(0) * box.Side(1);
  double reach = std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, to.size())));
  reach = std::max(reach, std::max(box.Side(0), box.Side(1)) / 1024.0);
  reach = reach > 0.0 ? reach : 1.0;
  while (!free.empty() && !left.empty())
  {
    const Bins bins(to, left, box, reach);
    std::vector<Candidate> candidates;
    for (const int i : free)
    {
      const auto& point = from[static_cast<std::size_t>(i)];
      bins.VisitNear(point, [&](int j) {
        const auto& other = to[static_cast<std::size_t>(j)];
        const double square = (other[0] - point[0]) * (other[0] - point[0]) +
          (other[1] - point[1]) * (other[1] - point[1]);
        if (square < reach * reach)
        {
          candidates.push_back({ square, i, j });
        }
      });
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& candidate : candidates)
    {
      int& mine = partner[static_cast<std::size_t>(candidate.From)];
      if (mine < 0 && !taken[static_cast<std::size_t>(candidate.To)])
      {
        mine = candidate.To;
        taken[static_cast<std::size_t>(candidate.To)] = true;
      }
    }
    const auto isPaired = [&](int i) { return partner[static_cast<std::size_t>(i)] >= 0; };
    free.erase(std::remove_if(free.begin(), free.end(), isPaired), free.end());
    const auto isTaken = [&](int j) { return taken[static_cast<std::size_t>(j)]; };
    left.erase(std::remove_if(left.begin(), left.end(), isTaken), left.end());
    reach *= 2.0;
  }
  return partner;
}
