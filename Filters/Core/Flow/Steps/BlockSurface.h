// SPDX-License-Identifier: BSD-3-Clause
// Points on the surface of a box: a lattice of `parts` + 1 of them along each edge. The parts of
// the sides between them are what a flow bends.
#ifndef RectifiedTransport_BlockSurface_h
#define RectifiedTransport_BlockSurface_h

#include "Core/Geometry/Points.h"

#include <array>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class BlockSurface
{
public:
  static constexpr int SideCorners = 1 << (Dimension - 1); // corners of a part of a side

  struct Part
  {
    int Axis; // the side is across it
    bool IsHigh;
    std::array<std::size_t, SideCorners> Points; // axis 0 fastest
  };

  // With one part the points are the corners; bit a of a number tells the end of axis a.
  explicit BlockSurface(int parts)
    : Parts(parts)
  {
    int all = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      all *= parts + 1;
    }
    // Numbers of the surface's points among the lattice's nodes.
    std::vector<std::size_t> numbers(static_cast<std::size_t>(all));
    for (int node = 0; node < all; ++node)
    {
      const std::array<int, Dimension> place = this->PlaceOf(node);
      numbers[static_cast<std::size_t>(node)] = this->Places.size();
      // A node with any coordinate at an end is on the surface.
      for (const int i : place)
      {
        if (i == 0 || i == parts)
        {
          this->Places.push_back(place);
          break;
        }
      }
    }
    for (int node = 0; node < all; ++node)
    {
      this->AddPartsAt(node, numbers);
    }
  }

  std::size_t Count() const { return this->Places.size(); }
  const std::vector<Part>& Sides() const { return this->AllParts; }

  // The point with this number on the surface of the box [low, high].
  Point<Dimension> At(
    std::size_t number, const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    Point<Dimension> point;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double u = static_cast<double>(this->Places[number][axis]) / this->Parts;
      point[axis] = (1.0 - u) * low[axis] + u * high[axis];
    }
    return point;
  }

private:
  // A node's place in the lattice of (parts + 1)^Dimension nodes.
  std::array<int, Dimension> PlaceOf(int node) const
  {
    std::array<int, Dimension> place;
    for (int& i : place)
    {
      i = node % (this->Parts + 1);
      node /= this->Parts + 1;
    }
    return place;
  }

  // Adds the parts of sides whose lowest corner is this node. A part lies across an axis where the
  // node is at an end of it, and has 2^(Dimension - 1) corners.
  void AddPartsAt(int node, const std::vector<std::size_t>& numbers)
  {
    const std::array<int, Dimension> place = this->PlaceOf(node);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      bool isLowest = place[axis] == 0 || place[axis] == this->Parts;
      Part part{ axis, place[axis] != 0, {} };
      std::size_t count = 0;
      for (int corner = 0; corner < 1 << Dimension; ++corner)
      {
        int at = node;
        for (int a = 0, stride = 1; a < Dimension; ++a, stride *= this->Parts + 1)
        {
          at += (corner >> a & 1) * stride;
          isLowest = isLowest && (a == axis || place[a] < this->Parts);
        }
        if ((corner >> axis & 1) == 0 && isLowest)
        {
          part.Points[count++] = numbers[static_cast<std::size_t>(at)];
        }
      }
      if (isLowest)
      {
        this->AllParts.push_back(part);
      }
    }
  }

  int Parts;
  std::vector<std::array<int, Dimension>> Places;
  std::vector<Part> AllParts;
};

} // namespace RectifiedTransport

#endif
