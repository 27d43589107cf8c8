// SPDX-License-Identifier: BSD-3-Clause
// The points and cells of a data set, as they are resampled to a grid.
#ifndef RectifiedTransport_CellSet_h
#define RectifiedTransport_CellSet_h

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// The cell types of VTK that are told apart, with the order of their points. Cells of all other
// types are divided into simplices.
enum class CellShape : unsigned char
{
  Other,
  Line,
  PolyLine,
  Triangle,
  Pixel,
  Quad,
  Polygon,
  Tetrahedron,
  Voxel,
  Hexahedron
};

// Reads the cells of a set. For one thread, as it has memory for the last cell.
class CellReader
{
public:
  using Ids = std::vector<std::int64_t>;

  CellReader() = default;
  virtual ~CellReader() = default;
  CellReader(const CellReader&) = delete;
  CellReader& operator=(const CellReader&) = delete;

  virtual CellShape ShapeOf(std::int64_t cell) const = 0;
  virtual int DimensionOf(std::int64_t cell) const = 0;
  // The points of a cell; valid until the next call.
  virtual const Ids& PointsOf(std::int64_t cell) = 0;
  // Finds the points of the simplices that make up a cell. Returns whether it can be divided.
  virtual bool Divide(std::int64_t cell, Ids& simplices) = 0;
  virtual void GetPosition(std::int64_t point, double* x) const = 0;
};

// What a data set has to provide: the bridge to VTK implements it.
class CellSet
{
public:
  // Flags of cells or points. A cell or point is hidden if its flags have a bit of the mask.
  struct HiddenFlags
  {
    const unsigned char* Flags = nullptr; // none are hidden
    unsigned char Mask = 0;

    bool Has(std::int64_t i) const { return this->Flags && (this->Flags[i] & this->Mask) != 0; }
    bool HasAny(const CellReader::Ids& ids) const;
  };

  virtual ~CellSet();
  CellSet(const CellSet&) = delete;
  CellSet& operator=(const CellSet&) = delete;

  virtual std::unique_ptr<CellReader> Read() const = 0;

  std::string Name; // in messages
  std::int64_t NumberOfPoints = 0;
  std::int64_t NumberOfCells = 0;
  double Rounding = 0.0; // what coordinates may be off by, relative to them
  HiddenFlags HiddenCells;
  HiddenFlags HiddenPoints; // and with them their cells

protected:
  CellSet() = default;
};

using CellSets = std::vector<std::shared_ptr<const CellSet>>;

} // namespace RectifiedTransport

#endif
