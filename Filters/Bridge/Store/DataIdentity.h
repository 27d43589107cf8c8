// SPDX-License-Identifier: BSD-3-Clause
// What a result was computed from, to decide whether it must be computed again.
#ifndef RectifiedTransport_DataIdentity_h
#define RectifiedTransport_DataIdentity_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <functional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class ImageGrid;
class Progress;
struct DensityRules;
struct FlowOptions;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Numbers, such as options; arrays; and the modification times of their owners. Equal numbers and
// times mean the same data. If times differ, a hash of the arrays' values decides: programs make
// new data sets around the same arrays, and write into arrays without marking them as modified.
class DataIdentity
{
public:
  // The hash of the values; 0 if there is none. May be collective.
  using Hasher = std::function<std::uint64_t(Progress&)>;

  void AddNumber(std::uint64_t number) { this->Numbers.push_back(number); }
  void AddNumbers(const double* numbers, int count);
  void AddGrid(const ImageGrid& grid);
  void AddOptions(const FlowOptions& options);
  void AddRules(const DensityRules& rules);
  void AddTime(std::uint64_t time) { this->Times.push_back(time); }
  // For an object that is no array, such as a vtkCellArray; nullptr is allowed.
  void AddTimeOf(vtkObject* object);
  // Its name, type, sizes and values; nullptr is allowed. The array must be there until Hash.
  void AddArray(vtkAbstractArray* array);
  // Takes the place of a hash of the arrays.
  void SetHasher(const Hasher& hasher) { this->Find = hasher; }
  // Data that depend on these and on other ones.
  void Add(const DataIdentity& other);

  // Computes the hash, once; the arrays and the hasher are not needed any more. Throws Cancelled.
  void Hash(Progress& progress);
  // Those below are false if the other one is not hashed.
  //
  // Whether times show that these are the other data.
  bool IsByTimes(const DataIdentity& other) const;
  // Whether these, hashed, are the other data.
  bool IsByContent(const DataIdentity& other) const;
  // Whether these are the data `before`; if so, it gets the times of these. Hashes these if times
  // do not show it. Throws Cancelled.
  bool IsSameAs(DataIdentity& before, Progress& progress);

  // Whether the values have a hash: arrays may be none in memory. Call it after Hash.
  bool HasHash() const { return this->Bits != 0; }
  // The numbers and the hash, of data without a hash their times.
  std::vector<std::uint64_t> Content() const;

private:
  std::vector<std::uint64_t> Numbers;
  std::vector<std::uint64_t> Times;  // and the addresses of what has them
  std::vector<vtkDataArray*> Arrays; // until the hash is there
  Hasher Find;
  std::vector<DataIdentity> Others; // until then, too
  std::uint64_t Bits = 0;           // the hash
  bool IsHashed = false;
};

} // namespace RectifiedTransport::Bridge

#endif
