// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/DuplicateTriangles.h"

#include <algorithm>
#include <array>

namespace RectifiedTransport
{

namespace
{

// A triangle with its points in a canonical order, so that equal ones are neighbours after sorting.
struct Candidate
{
  std::array<std::int64_t, 3> Points; // ascending
  bool IsEven;                        // their order in the triangle is an even permutation of that
  std::int64_t Triangle;
};

Candidate candidateOf(const TriangleSurface& surface, std::int64_t triangle)
{
  const std::int64_t* ids = surface.Triangles + 3 * triangle;
  Candidate candidate{ { ids[0], ids[1], ids[2] }, true, triangle };
  std::sort(candidate.Points.begin(), candidate.Points.end());
  // With the lowest point first, the other two ascend in an even permutation only.
  const auto lowest = static_cast<std::size_t>(std::min_element(ids, ids + 3) - ids);
  candidate.IsEven = ids[(lowest + 1) % 3] == candidate.Points[1];
  return candidate;
}

// Appends what to drop of the triangles [begin, end) of the same points, by each of the three
// rules.
void dropGroup(
  const Candidate* begin, const Candidate* end, std::array<std::vector<std::int64_t>, 3>& repeated)
{
  auto& [byDirection, byNumber, allButOne] = repeated;
  const auto isEven = [](const Candidate& c) { return c.IsEven; };
  for (const Candidate* c = begin + 1; c < end; ++c)
  {
    allButOne.push_back(c->Triangle);
  }
  // Triangles of both directions cancel: all are dropped.
  const bool cancels = std::any_of(begin, end, isEven) && !std::all_of(begin, end, isEven);
  for (const Candidate* c = cancels ? begin : begin + 1; c < end; ++c)
  {
    byDirection.push_back(c->Triangle);
  }
  // If their number is odd, one stays: one of the more frequent direction.
  const bool isOdd = (end - begin) % 2 == 1;
  const bool most = 2 * std::count_if(begin, end, isEven) > end - begin;
  const Candidate* stays =
    isOdd ? std::find_if(begin, end, [most](const Candidate& c) { return c.IsEven == most; }) : end;
  for (const Candidate* c = begin; c < end; ++c)
  {
    if (c != stays)
    {
      byNumber.push_back(c->Triangle);
    }
  }
}

} // namespace

std::array<std::vector<std::int64_t>, 3> findDropped(
  const TriangleSurface& surface, const SurfaceEdges& edges)
{
  std::vector<Candidate> candidates;
  for (std::int64_t i = 0; i < surface.NumberOfTriangles; ++i)
  {
    // Each edge of a repeated triangle has more than two triangles; Other() is -1 there, and on
    // boundaries.
    if (edges.Other(3 * i) < 0 && edges.Other(3 * i + 1) < 0 && edges.Other(3 * i + 2) < 0)
    {
      candidates.push_back(candidateOf(surface, i));
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.Points != b.Points ? a.Points < b.Points : a.Triangle < b.Triangle;
  });
  std::array<std::vector<std::int64_t>, 3> repeated;
  const Candidate* end = candidates.data() + candidates.size();
  for (const Candidate* begin = candidates.data(); begin < end;)
  {
    const Candidate* next =
      std::find_if(begin, end, [begin](const Candidate& c) { return c.Points != begin->Points; });
    if (next - begin > 1)
    {
      dropGroup(begin, next, repeated);
    }
    begin = next;
  }
  for (std::vector<std::int64_t>& way : repeated)
  {
    std::sort(way.begin(), way.end());
  }
  return repeated;
}

std::int64_t dropTriangles(
  const TriangleSurface& surface, const std::vector<std::int64_t>& dropped, std::int64_t* kept)
{
  auto next = dropped.begin();
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < surface.NumberOfTriangles; ++i)
  {
    if (next != dropped.end() && *next == i)
    {
      ++next;
      continue;
    }
    std::copy_n(surface.Triangles + 3 * i, 3, kept + 3 * count++);
  }
  return count;
}

} // namespace RectifiedTransport
