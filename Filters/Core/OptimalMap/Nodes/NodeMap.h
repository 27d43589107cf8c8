// SPDX-License-Identifier: BSD-3-Clause
// A map that is given at nodes, and the images of the cells between them.
#ifndef RectifiedTransport_NodeMap_h
#define RectifiedTransport_NodeMap_h

#include "Core/Grid/NodeGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Coordinates are in cells of the nodes.
template <int Dimension>
struct NodeMap
{
  NodeGrid<Dimension> Grid;
  std::array<NodeValues, Dimension> Images; // a coordinate each, at the nodes

  // A map with memory for the images, which are not initialised.
  static NodeMap On(const NodeGrid<Dimension>& grid)
  {
    NodeMap map;
    map.Grid = grid;
    for (NodeValues& coordinate : map.Images)
    {
      coordinate = NodeValues(grid.NumberOfNodes());
    }
    return map;
  }

  // The multilinear interpolant of the images.
  Point<Dimension> At(const double* point) const
  {
    const HatWeights<Dimension> hats(point, this->Grid.Cells);
    Point<Dimension> image;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      image[axis] = hats.Interpolate(this->Images[axis].data());
    }
    return image;
  }
};

// Writes x - grad potential(x) at the nodes, by central differences, clamped to the box; from and
// to physical lengths by the grid's spacing. Adds a unit of work for each node and axis. Throws
// Cancelled. The map has memory already.
template <int Dimension>
void writeGradientMap(const double* potential, NodeMap<Dimension>& map, Progress& progress);

// Smooths the images of each node and its neighbours by the weights 1/4, 1/2, 1/4 along each axis:
// a potential that is transformed on nodes has a gradient that forms stairs. Nodes at the ends of
// an axis keep theirs along it. Adds units of work. Throws Cancelled.
template <int Dimension>
void smoothMap(NodeMap<Dimension>& map, Progress& progress);

// One of the equal parts of a cell between nodes.
template <int Dimension>
struct CellSample
{
  std::int64_t Cell; // axis 0 fastest
  double Mass;
  GridSize<Dimension> Part;  // along each axis
  GridSize<Dimension> Parts; // the number of parts of the cell along each axis

  // The middle of the part, in cells of the nodes.
  Point<Dimension> Place(const GridSize<Dimension>& cells) const
  {
    Point<Dimension> place;
    std::int64_t rest = this->Cell;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      place[axis] = static_cast<double>(rest % cells[axis]) +
        (static_cast<double>(this->Part[axis]) + 0.5) / static_cast<double>(this->Parts[axis]);
      rest /= cells[axis];
    }
    return place;
  }
};

// Samples for each cell of the nodes that a cell is stretched over along an axis; each cell has at
// least one.
struct SampleFineness
{
  double Each = 1.0;
  double OfLightCells = 1.0;
  double LightMass = 0.0; // Cells with less mass are light.
};

// The images of the cells of rows along axis 0. Each cell is divided into as many samples along an
// axis as the map stretches it there, at most 64.
template <int Dimension>
class ImageSamples
{
public:
  // The map must live as long.
  explicit ImageSamples(const NodeMap<Dimension>& map, const SampleFineness& fineness = {})
    : Map(map)
    , Fineness(fineness)
    , Nodes(static_cast<std::size_t>(map.Grid.Cells[0] + 1))
    , Scratch(this->Nodes * (2 * Dimension + 1))
  {
  }

  static std::int64_t NumberOfRows(const NodeGrid<Dimension>& grid)
  {
    return grid.NumberOfCells() / grid.Cells[0];
  }

  // Calls visit(sample, image) for each sample of the row's cells with mass; `masses` are those of
  // all cells, null if each has the mass 1.
  template <class Visit>
  void ForRow(std::int64_t row, const double* masses, const Visit& visit)
  {
    const GridSize<Dimension>& cells = this->Map.Grid.Cells;
    const std::int64_t first = row * cells[0];
    if (masses && std::all_of(masses + first, masses + first + cells[0], [](double mass) {
          return mass == 0.0;
        }))
    {
      return;
    }
    this->FindCorners(row);
    this->TakeMiddles();
    this->MeasureExtents();
    for (std::int64_t i = 0; i < cells[0]; ++i)
    {
      const double mass = masses ? masses[first + i] : 1.0;
      if (mass != 0.0)
      {
        this->ForCell(i, first + i, mass, visit);
      }
    }
  }

  // How many samples ForRow would visit.
  double CountRow(std::int64_t row, const double* masses)
  {
    this->FindCorners(row);
    this->MeasureExtents();
    const std::int64_t first = row * this->Map.Grid.Cells[0];
    double count = 0.0;
    for (std::int64_t i = 0; i < this->Map.Grid.Cells[0]; ++i)
    {
      const double mass = masses ? masses[first + i] : 1.0;
      int parts[3] = { 1, 1, 1 };
      count += mass != 0.0 ? this->Divide(i, mass, parts) : 0;
    }
    return count;
  }

private:
  static constexpr int Lines = 1 << (Dimension - 1); // lines of nodes about a row of cells
  static constexpr int MostSamples = 64;

  double* Middle(int axis) { return this->Scratch.data() + this->Nodes * Index(axis); }
  double* Extent(int axis) { return this->Middle(Dimension + axis); }
  double* Across() { return this->Middle(2 * Dimension); }
  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }

  // Pointers to the images of the lines of nodes about a row of cells, a coordinate each.
  void FindCorners(std::int64_t row)
  {
    const GridSize<Dimension>& cells = this->Map.Grid.Cells;
    for (int line = 0; line < Lines; ++line)
    {
      std::int64_t rest = row;
      std::int64_t node = 0;
      for (int axis = 1; axis < Dimension; ++axis)
      {
        node += (rest % cells[axis] + ((line >> (axis - 1)) & 1)) * this->Map.Grid.Stride(axis);
        rest /= cells[axis];
      }
      for (int axis = 0; axis < Dimension; ++axis)
      {
        this->Corners[Index(axis)][Index(line)] = this->Map.Images[Index(axis)].data() + node;
      }
    }
  }

  // The images of the cells' centres: means of the corners.
  void TakeMiddles()
  {
    constexpr double share = 1.0 / (1 << Dimension);
    double* across = this->Across();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto& corners = this->Corners[Index(axis)];
      for (std::size_t i = 0; i < this->Nodes; ++i)
      {
        double sum = 0.0;
        for (int line = 0; line < Lines; ++line)
        {
          sum += corners[Index(line)][i];
        }
        across[i] = share * sum;
      }
      double* middle = this->Middle(axis);
      for (std::size_t i = 0; i + 1 < this->Nodes; ++i)
      {
        middle[i] = across[i] + across[i + 1];
      }
    }
  }

  // The extents of cells' images along each axis of the cell, in cells: the longest extent in any
  // coordinate among the images of its edges along that axis.
  void MeasureExtents()
  {
    double* along = this->Extent(0);
    std::fill_n(along, this->Nodes, 0.0);
    for (const auto& corners : this->Corners)
    {
      for (const double* x : corners)
      {
        for (std::size_t i = 0; i + 1 < this->Nodes; ++i)
        {
          along[i] = std::max(along[i], std::abs(x[i + 1] - x[i]));
        }
      }
    }
    double* across = this->Across();
    for (int axis = 1; axis < Dimension; ++axis)
    {
      const int bit = 1 << (axis - 1);
      std::fill_n(across, this->Nodes, 0.0);
      for (const auto& corners : this->Corners)
      {
        for (int line = 0; line < Lines; ++line)
        {
          if ((line & bit) == 0)
          {
            const double* x = corners[Index(line)];
            const double* y = corners[Index(line | bit)];
            for (std::size_t i = 0; i < this->Nodes; ++i)
            {
              across[i] = std::max(across[i], std::abs(y[i] - x[i]));
            }
          }
        }
      }
      double* extent = this->Extent(axis);
      for (std::size_t i = 0; i + 1 < this->Nodes; ++i)
      {
        extent[i] = std::max(across[i], across[i + 1]);
      }
    }
  }

  // The number of parts along each axis of a cell of the row. Returns the product.
  int Divide(std::int64_t i, double mass, int (&parts)[3])
  {
    constexpr double tolerance = 0.02; // lets an extent just above a whole number have no part more
    const double fineness =
      mass < this->Fineness.LightMass ? this->Fineness.OfLightCells : this->Fineness.Each;
    int all = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double wanted = std::ceil(this->Extent(axis)[i] * fineness - tolerance);
      parts[axis] = static_cast<int>(std::clamp(wanted, 1.0, 1.0 * MostSamples));
      all *= parts[axis];
    }
    return all;
  }

  // A cell's image is multilinear in its corners: along axis 0 samples are even steps from one face
  // to the other, whose ends are interpolated once for all samples of a line.
  template <class Visit>
  void ForCell(std::int64_t i, std::int64_t cell, double mass, const Visit& visit)
  {
    CellSample<Dimension> sample{ cell, mass, {}, {} };
    int parts[3] = { 1, 1, 1 };
    const int all = this->Divide(i, mass, parts);
    std::copy_n(parts, Dimension, sample.Parts.begin());
    Point<Dimension> image;
    if (all == 1)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        image[Index(axis)] = this->Middle(axis)[i];
      }
      visit(sample, image);
      return;
    }
    sample.Mass = mass / all;
    for (int line = 0; line < parts[1] * parts[2]; ++line)
    {
      const int b = line % parts[1];
      const int c = line / parts[1];
      const double y = (b + 0.5) / parts[1];
      const double z = (c + 0.5) / parts[2];
      if constexpr (Dimension > 1)
      {
        sample.Part[1] = b;
      }
      if constexpr (Dimension > 2)
      {
        sample.Part[2] = c;
      }
      Point<Dimension> begin;
      Point<Dimension> step;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double low = this->Across(i, axis, y, z);
        step[Index(axis)] = (this->Across(i + 1, axis, y, z) - low) / parts[0];
        begin[Index(axis)] = low + 0.5 * step[Index(axis)];
      }
      for (int a = 0; a < parts[0]; ++a)
      {
        sample.Part[0] = a;
        for (std::size_t axis = 0; axis < begin.size(); ++axis)
        {
          image[axis] = begin[axis] + a * step[axis];
        }
        visit(sample, image);
      }
    }
  }

  // A coordinate of the image of the place (y, z) on the face at node i of the row, by bilinear
  // interpolation.
  double Across(std::int64_t i, int axis, double y, double z) const
  {
    const auto& corners = this->Corners[Index(axis)];
    if constexpr (Dimension == 1)
    {
      return corners[0][i];
    }
    else if constexpr (Dimension == 2)
    {
      return corners[0][i] + y * (corners[1][i] - corners[0][i]);
    }
    else
    {
      const double low = corners[0][i] + z * (corners[2][i] - corners[0][i]);
      const double high = corners[1][i] + z * (corners[3][i] - corners[1][i]);
      return low + y * (high - low);
    }
  }

  const NodeMap<Dimension>& Map;
  SampleFineness Fineness;
  std::size_t Nodes;
  std::vector<double> Scratch;
  std::array<std::array<const double*, Lines>, Dimension> Corners{};
};

// A fineness, or a lower one for maps that stretch most cells, as those of noise do: there are
// about four samples a cell at most, by those of every eighth row, so that the time is that of
// other maps. Adds no units of work. Throws Cancelled.
template <int Dimension>
SampleFineness limitFineness(
  const NodeMap<Dimension>& map, const double* masses, SampleFineness fineness, Progress& progress);

} // namespace RectifiedTransport

#endif
