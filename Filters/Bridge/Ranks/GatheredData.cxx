// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/GatheredData.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Ranks/DataSetBytes.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Ranks/TruncatedArrays.h"
#include "Bridge/Run/Fingerprint.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"
#include "vtkStructuredGrid.h"
#include "vtkStructuredGridAppend.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

using Key = std::array<std::uint64_t, 2>; // the number of a part, and its fingerprint
using Keys = std::vector<Key>;            // one key for each part of a rank

// Whether a part is one that no lower rank has.
bool isFirst(const std::vector<Keys>& all, std::size_t rank, const Key& key)
{
  return std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rank),
    [&](const Keys& lower) { return std::find(lower.begin(), lower.end(), key) != lower.end(); });
}

// One part of a message: three lengths of 8 bytes, then the name, the list of short arrays, and the
// data set without these. All lengths are in bytes.
void append(const DataPart& part, Bytes& to)
{
  const TruncatedArrays tooShort(part.Data);
  const std::string text = tooShort.Text();
  const Bytes data = bytesOfDataSet(tooShort.RemovedFrom(part.Data.Get()));
  const std::uint64_t lengths[3] = { part.Name.size(), text.size(), data.size() };
  const Bytes head = toBytes(lengths, 3);
  to.insert(to.end(), head.begin(), head.end());
  to.insert(to.end(), part.Name.begin(), part.Name.end());
  to.insert(to.end(), text.begin(), text.end());
  to.insert(to.end(), data.begin(), data.end());
}

std::vector<DataPart> partsFrom(const Bytes& bytes)
{
  std::vector<DataPart> parts;
  // A rank may have sent no part: the loop then runs over nothing.
  for (const char* at = bytes.data(); at != bytes.data() + bytes.size();)
  {
    constexpr std::size_t head = 3 * sizeof(std::uint64_t);
    const auto lengths = fromBytes<std::uint64_t>(Bytes(at, at + head));
    at += head;
    DataPart part;
    part.Name.assign(at, at + lengths[0]);
    at += lengths[0];
    const TruncatedArrays tooShort = TruncatedArrays(std::string(at, at + lengths[1]));
    at += lengths[1];
    part.Data = dataSetOfBytes(at, lengths[2]);
    tooShort.AddEmptyTo(part.Data);
    at += lengths[2];
    parts.push_back(std::move(part));
  }
  return parts;
}

// Sends the parts of this rank that count.
// The same bytes for every receiver, or for the first rank alone: to all others it sends messages
// without bytes, because the exchange is collective.
std::vector<Bytes> exchange(Bytes own, const Ranks& ranks, Receivers receivers)
{
  if (receivers == Receivers::All)
  {
    return ranks.Gather(own);
  }
  std::vector<Bytes> parts(static_cast<std::size_t>(ranks.Count()));
  parts.front() = std::move(own);
  return ranks.Exchange(std::move(parts));
}

} // namespace

GatheredParts gatherDataParts(
  const std::vector<DataPart>& own, const Ranks& ranks, Receivers receivers)
{
  // Numbers and fingerprints of 16 bytes a part tell every rank which parts are repeated, before
  // any data are sent.
  Keys keys;
  for (const DataPart& part : own)
  {
    keys.push_back(
      { static_cast<std::uint64_t>(part.Number), sampledFingerprint({ part.Data.Get() }) });
  }
  std::vector<Keys> all;
  for (const Bytes& bytes : ranks.Gather(toBytes(keys)))
  {
    all.push_back(fromBytes<Key>(bytes));
  }
  const auto self = static_cast<std::size_t>(ranks.Own());
  GatheredParts gathered;
  const bool receives = receivers == Receivers::All || self == 0;
  // If all ranks have the same parts, as when each of them reads the whole file, nothing is sent.
  gathered.AreWhole =
    std::all_of(all.begin(), all.end(), [&](const Keys& keysThere) { return keysThere == all[0]; });
  if (gathered.AreWhole)
  {
    gathered.Parts = receives ? own : std::vector<DataPart>();
    return gathered;
  }
  // Rank 0 sends nothing to itself where it is the only receiver.
  Bytes sent;
  for (std::size_t i = 0; i < own.size() && (self > 0 || receivers == Receivers::All); ++i)
  {
    if (isFirst(all, self, keys[i]))
    {
      append(own[i], sent);
    }
  }
  // A rank's own parts are not read from bytes: they stay the data sets that they are, with all
  // arrays.
  std::vector<Bytes> received = exchange(std::move(sent), ranks, receivers);
  for (std::size_t rank = 0; rank < received.size() && receives; ++rank)
  {
    std::vector<DataPart> parts = rank == self ? own : partsFrom(received[rank]);
    // Bytes and data sets of one rank only are in memory together.
    received[rank] = Bytes();
    std::size_t next = 0;
    for (std::size_t i = 0; i < all[rank].size(); ++i)
    {
      // Senders left out what a lower rank has, by the same rule: messages have only the parts that
      // count.
      if (isFirst(all, rank, all[rank][i]))
      {
        DataPart& part = parts[rank == self ? i : next++];
        part.Number = static_cast<std::int64_t>(all[rank][i][0]);
        gathered.Parts.push_back(part);
      }
    }
  }
  // The order is that of numbers, then of ranks, whatever ranks had which part.
  std::stable_sort(gathered.Parts.begin(), gathered.Parts.end(),
    [](const DataPart& a, const DataPart& b) { return a.Number < b.Number; });
  return gathered;
}

namespace
{

// Points at a distance of less differ by rounding alone: ranks may have computed the same point
// with errors of a few units in the last place of the farthest coordinate.
double roundingOf(vtkPolyData* all)
{
  // Absolute coordinates matter: far from the origin, rounding is larger than near it.
  double bounds[6];
  all->GetPoints()->GetBounds(bounds);
  double farthest = 0.0;
  for (const double bound : bounds)
  {
    farthest = std::max(farthest, std::abs(bound));
  }
  // Units in the last place. Points at a larger distance are different ones.
  constexpr double units = 4.0;
  return units * farthest *
    (all->GetPoints()->GetDataType() == VTK_FLOAT ? std::numeric_limits<float>::epsilon()
                                                  : std::numeric_limits<double>::epsilon());
}

// The point that each point becomes. Parts of lower ranks come first, so a point that lies within
// rounding of one in a lower part is merged with it; points of one part stay apart.
std::vector<vtkIdType> pointsToKeep(vtkPolyData* all, const std::vector<DataPart>& parts)
{
  // The points of `all` are those of the parts one after the other: part k has the points [first,
  // end).
  std::vector<vtkIdType> becomes(static_cast<std::size_t>(all->GetNumberOfPoints()));
  vtkNew<vtkStaticPointLocator> places;
  places->SetDataSet(all);
  places->BuildLocator();
  const double rounding = roundingOf(all);
  vtkNew<vtkIdList> near;
  vtkIdType first = 0;
  for (const DataPart& part : parts)
  {
    const vtkIdType end = first + part.Data->GetNumberOfPoints();
    for (vtkIdType i = first; i < end; ++i)
    {
      vtkIdType point = i;
      double x[3];
      all->GetPoint(i, x);
      places->FindPointsWithinRadius(rounding, x, near);
      for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
      {
        const vtkIdType other = near->GetId(k);
        // The lowest one wins, so that the result does not depend on the order in which the locator
        // finds them.
        point = other < first ? std::min(point, other) : point;
      }
      // The other one may itself have become a point of a still lower part.
      becomes[static_cast<std::size_t>(i)] =
        point < i ? becomes[static_cast<std::size_t>(point)] : i;
    }
    first = end;
  }
  return becomes;
}

// Cells with new numbers of their points. The number of cells and their order stay, so that cell
// data do, too. A cell whose corners were merged may become degenerate.
vtkSmartPointer<vtkCellArray> withPoints(
  vtkCellArray* cells, const std::vector<vtkIdType>& newPoints)
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  made->AllocateExact(cells->GetNumberOfCells(), cells->GetNumberOfConnectivityIds());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, corners);
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      corners->SetId(i, newPoints[static_cast<std::size_t>(corners->GetId(i))]);
    }
    made->InsertNextCell(corners);
  }
  return made;
}

// Points of different parts whose coordinates differ by their rounding only become that of the
// lowest part; those of one part stay apart. `all` has the points and cells of the parts in their
// order.
vtkSmartPointer<vtkPolyData> joinSurface(vtkPolyData* all, const std::vector<DataPart>& parts)
{
  // A point keeps its arrays from the lowest rank that has it.
  const std::vector<vtkIdType> becomes = pointsToKeep(all, parts);
  vtkNew<vtkIdList> kept;
  std::vector<vtkIdType> newPoints(becomes.size());
  for (std::size_t i = 0; i < becomes.size(); ++i)
  {
    const auto old = static_cast<vtkIdType>(i);
    if (becomes[i] == old)
    {
      newPoints[i] = kept->GetNumberOfIds();
      kept->InsertNextId(old);
    }
    else
    {
      // That point has a lower number, and its new number already.
      newPoints[i] = newPoints[static_cast<std::size_t>(becomes[i])];
    }
  }
  auto joined = vtkSmartPointer<vtkPolyData>::New();
  copyPoints(all, kept, joined);
  // The four kinds of cells in vtkPolyData's order, to which the cell data belong.
  joined->SetVerts(withPoints(all->GetVerts(), newPoints));
  joined->SetLines(withPoints(all->GetLines(), newPoints));
  joined->SetPolys(withPoints(all->GetPolys(), newPoints));
  joined->SetStrips(withPoints(all->GetStrips(), newPoints));
  joined->GetCellData()->PassData(all->GetCellData());
  return joined;
}

// The set without the cells that another rank has, too. A structured grid keeps all its cells,
// because its type cannot leave any out.
vtkSmartPointer<vtkPointSet> withoutGhostCells(vtkPointSet* set)
{
  const unsigned char* flags = ghostFlags(set, vtkDataObject::CELL, "input point set");
  // Blanked cells alone need no copy: the filters themselves leave them out.
  const bool hasDuplicates = flags &&
    std::any_of(flags, flags + set->GetNumberOfCells(),
      [](unsigned char flag) { return (flag & vtkDataSetAttributes::DUPLICATECELL) != 0; });
  if (!hasDuplicates)
  {
    return set;
  }
  const TruncatedArrays tooShort(set);
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(set->NewInstance());
  copy->ShallowCopy(tooShort.RemovedFrom(set));
  if (auto* surface = vtkPolyData::SafeDownCast(copy))
  {
    surface->RemoveGhostCells();
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(copy))
  {
    grid->RemoveGhostCells();
  }
  tooShort.AddEmptyTo(copy);
  return copy;
}

// What counts of this rank's set; nullptr for nothing.
vtkSmartPointer<vtkPointSet> countedPart(vtkPointSet* own, PointSetKind kind, const Ranks& ranks)
{
  vtkSmartPointer<vtkPointSet> part;
  if (kind == PointSetKind::Points)
  {
    part = countedPoints(own, ranks);
  }
  else if (own && own->GetNumberOfPoints() > 0)
  {
    part = withoutGhostCells(own);
  }
  return part && part->GetNumberOfPoints() > 0 ? part : nullptr;
}

// Append filters keep the arrays that all parts have. Where a part has ghost flags, others without
// get flags of 0, so that what is hidden stays hidden.
void addGhostFlags(std::vector<DataPart>& parts)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    const auto lacksFlags = [&](const DataPart& part) {
      return !part.Data->GetAttributes(owner)->HasArray(vtkDataSetAttributes::GhostArrayName());
    };
    if (std::all_of(parts.begin(), parts.end(), lacksFlags))
    {
      continue;
    }
    for (DataPart& part : parts)
    {
      if (lacksFlags(part))
      {
        // The rank's own data are the filter's input, which stays as it is.
        const auto copy = vtkSmartPointer<vtkDataSet>::Take(part.Data->NewInstance());
        copy->ShallowCopy(part.Data);
        owner == vtkDataObject::POINT ? copy->AllocatePointGhostArray()
                                      : copy->AllocateCellGhostArray();
        part.Data = copy;
      }
    }
  }
}

// All parts appended by one of VTK's filters, which keeps the arrays that all parts have. Field
// data are those of the first part.
template <class AppendT>
vtkSmartPointer<vtkPointSet> appendWith(const std::vector<DataPart>& parts)
{
  vtkNew<AppendT> append;
  for (const DataPart& part : parts)
  {
    append->AddInputDataObject(part.Data);
  }
  append->Update();
  vtkSmartPointer<vtkPointSet> made = append->GetOutput();
  made->GetFieldData()->ShallowCopy(parts.front().Data->GetFieldData());
  return made;
}

// VTK's filters would skip parts of another type without a word. The ranks that are no receivers
// have no parts; the error reaches them in the next exchange.
void requireOneType(const std::vector<DataPart>& parts)
{
  for (const DataPart& part : parts)
  {
    if (part.Data->GetDataObjectType() != parts.front().Data->GetDataObjectType())
    {
      throw Failure("The input is a " + std::string(parts.front().Data->GetClassName()) +
        " on one rank and a " + part.Data->GetClassName() + " on another; it must be of one type");
    }
  }
}

vtkSmartPointer<vtkPointSet> joinWhole(const std::vector<DataPart>& parts, PointSetKind kind)
{
  // Pieces of structured grids are put together by their extents, others one after the other.
  vtkDataSet* first = parts.front().Data;
  if (vtkPolyData::SafeDownCast(first))
  {
    vtkSmartPointer<vtkPointSet> all = appendWith<vtkAppendPolyData>(parts);
    if (kind == PointSetKind::Surface)
    {
      all = joinSurface(vtkPolyData::SafeDownCast(all), parts);
    }
    return all;
  }
  return vtkStructuredGrid::SafeDownCast(first) ? appendWith<vtkStructuredGridAppend>(parts)
                                                : appendWith<vtkAppendFilter>(parts);
}

vtkSmartPointer<vtkPointSet> joinParts(std::vector<DataPart> parts, PointSetKind kind)
{
  // This rank is no receiver, or no rank has points.
  if (parts.empty())
  {
    return nullptr;
  }
  requireOneType(parts);
  // One part is the whole: without an append filter its cells, arrays and attributes stay as they
  // are.
  if (parts.size() == 1)
  {
    return vtkPointSet::SafeDownCast(parts.front().Data);
  }
  // An array that is short on one rank is taken out on all: append filters would read past its end.
  TruncatedArrays tooShort;
  for (const DataPart& part : parts)
  {
    tooShort.Add(TruncatedArrays(part.Data));
  }
  for (DataPart& part : parts)
  {
    part.Data = tooShort.RemovedFrom(part.Data.Get());
  }
  addGhostFlags(parts);
  vtkSmartPointer<vtkPointSet> joined = joinWhole(parts, kind);
  tooShort.AddEmptyTo(joined);
  return joined;
}

} // namespace

vtkSmartPointer<vtkPointSet> gatherPoints(
  vtkPointSet* own, const Ranks& ranks, Receivers receivers, PointSetKind kind)
{
  if (!ranks.AreSeveral())
  {
    return own;
  }
  // A rank without points takes part with an empty list: the exchange is collective.
  std::vector<DataPart> parts;
  if (const vtkSmartPointer<vtkPointSet> points = countedPart(own, kind, ranks))
  {
    parts.push_back({ 0, "input", points });
  }
  return joinParts(gatherDataParts(parts, ranks, receivers).Parts, kind);
}

} // namespace RectifiedTransport::Bridge
