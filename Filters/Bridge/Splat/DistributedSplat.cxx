// SPDX-License-Identifier: BSD-3-Clause
// Each point goes to the ranks whose boxes its kernel reaches; these put what they receive in order
// and splat it onto their boxes.
#include "Bridge/Splat/DistributedSplat.h"

#include "Bridge/Points/DoubleTuples.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Splat/SplatSetup.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// What a rank gives and wants.
struct Part
{
  TupleBox Wanted;
  std::int64_t Points;
  bool IsSingle; // precision
  bool HasMasses;
  bool HasOrder;
  double MassEach;
};

// What all ranks do alike.
struct Agreement
{
  std::vector<TupleBox> Wanted;
  bool IsSingle = true;
  bool HasMasses = false;
  bool HasOrder = true;
  double MassEach = 1.0;
};

Agreement agreementOf(const Part& own, const Ranks& ranks)
{
  Agreement all;
  bool isFirst = true;
  for (const Part& part : gatherValues(ranks, own))
  {
    all.Wanted.push_back(part.Wanted);
    if (part.Points == 0)
    {
      continue;
    }
    all.IsSingle = all.IsSingle && part.IsSingle;
    all.HasOrder = all.HasOrder && part.HasOrder;
    all.HasMasses = all.HasMasses || part.HasMasses || (!isFirst && part.MassEach != all.MassEach);
    all.MassEach = part.MassEach;
    isFirst = false;
  }
  return all;
}

// Points as records of their coordinates, and where all have them their masses and keys.
template <class Real>
class PointRecords
{
public:
  PointRecords(bool hasMasses, bool hasOrder)
    : MassAt(3 * sizeof(Real))
    , KeyAt(this->MassAt + (hasMasses ? sizeof(double) : 0))
    , Size(this->KeyAt + (hasOrder ? sizeof(std::int64_t) : 0))
  {
  }

  void Append(const Real* point, double mass, std::int64_t key, Bytes& to) const
  {
    char record[3 * sizeof(Real) + sizeof(double) + sizeof(std::int64_t)];
    std::memcpy(record + this->MassAt, &mass, this->KeyAt - this->MassAt);
    std::memcpy(record + this->KeyAt, &key, this->Size - this->KeyAt);
    std::memcpy(record, point, this->MassAt);
    to.insert(to.end(), record, record + this->Size);
  }
  void ReadPoint(const char* record, Real* point) const
  {
    std::memcpy(point, record, this->MassAt);
  }
  double Mass(const char* record) const { return this->Read<double>(record + this->MassAt); }
  std::int64_t Key(const char* record) const
  {
    return this->Read<std::int64_t>(record + this->KeyAt);
  }
  std::size_t Length() const { return this->Size; }

private:
  template <class T>
  static T Read(const char* from)
  {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }

  std::size_t MassAt;
  std::size_t KeyAt;
  std::size_t Size;
};

template <int D, class Real>
class DistributedSplat
{
public:
  DistributedSplat(const SplatParticles<D, Real>& particles, const std::int64_t* order,
    const SplatTarget& target, const Agreement& all, const Ranks& ranks)
    : Own(particles)
    , Order(all.HasOrder ? order : nullptr)
    , Target(target)
    , All(all)
    , Records(all.HasMasses, all.HasOrder)
    , Processes(ranks)
  {
  }

  std::int64_t Run(Progress& progress, double* cells)
  {
    Stages stages(progress, { { "exchange", 2 }, { "splat", 8 } });
    const std::int64_t outside = this->Distribute(stages["exchange"]);
    this->Receive(this->Processes.Exchange(std::move(this->Parts)), stages["exchange"]);
    const SplatParticles<D, Real> received{ { this->Points.data(), this->Points.size() / 3 },
      this->Masses.data(), this->All.MassEach, this->Own.ToIndex };
    const auto own = static_cast<std::size_t>(this->Processes.Own());
    splatMass<D, Real>(received, this->Target.Geometry.template Size<D>(),
      latticePartOf<D>(this->All.Wanted[own], this->Target.Geometry), this->Target.Options,
      this->Target.Scale(), cells, stages["splat"]);
    return sumOverRanks(this->Processes, outside);
  }

private:
  // Appends each point to the parts of the ranks that it reaches. Returns how many are outside.
  std::int64_t Distribute(Progress& progress)
  {
    constexpr int block = 1024;
    const SplatSetup<D, Real> setup(
      this->Own, this->Target.Geometry.template Size<D>(), this->Target.Options);
    std::vector<LatticePart<D>> boxes;
    for (const TupleBox& wanted : this->All.Wanted)
    {
      boxes.push_back(latticePartOf<D>(wanted, this->Target.Geometry));
    }
    this->Parts.resize(boxes.size());
    std::vector<std::int32_t> cells(3 * block);
    std::int64_t outside = 0;
    progress.ForInOrder(this->Own.Points.size(), block, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t first = begin; first < end; first += block)
      {
        const int count = static_cast<int>(std::min<std::int64_t>(block, end - first));
        outside += setup.Kernels.Find(setup.Job, first, count, cells.data());
        for (std::size_t rank = 0; rank < boxes.size(); ++rank)
        {
          this->AppendThose(setup.Job, boxes[rank], first, count, cells.data(), this->Parts[rank]);
        }
      }
    });
    return outside;
  }

  // Of `count` points those that reach a box, by the first of the cells of each.
  void AppendThose(const SplatJob<D, Real>& job, const LatticePart<D>& box, std::int64_t first,
    int count, const std::int32_t* cells, Bytes& to) const
  {
    for (int i = 0; i < count && box.Count() > 0; ++i)
    {
      bool reaches = true;
      for (int a = 0; a < D; ++a)
      {
        const std::int32_t cell = cells[3 * i + a];
        reaches = reaches && cell < box.Low[a] + box.Cells[a] && cell + job.Kept[a] > box.Low[a];
      }
      if (reaches)
      {
        const std::int64_t point = first + i;
        this->Records.Append(this->Own.Points[point],
          this->Own.Masses ? this->Own.Masses[point] : this->Own.Mass,
          this->Order ? this->Order[point] : 0, to);
      }
    }
  }

  // Puts the points of all ranks in order.
  void Receive(std::vector<Bytes> received, Progress& progress)
  {
    const std::size_t length = this->Records.Length();
    std::size_t bytes = 0;
    for (const Bytes& part : received)
    {
      bytes += part.size();
    }
    const auto count = static_cast<std::int64_t>(bytes / length);
    this->Points = LargeBuffer<Real>(3 * count);
    if (this->All.HasMasses)
    {
      this->Masses = LargeBuffer<double>(count);
    }
    std::vector<Sorted> records;
    if (this->All.HasOrder)
    {
      records.reserve(static_cast<std::size_t>(count));
    }
    std::int64_t place = 0;
    for (Bytes& part : received)
    {
      for (std::size_t at = 0; at < part.size(); at += length)
      {
        const char* record = part.data() + at;
        if (this->All.HasOrder)
        {
          records.push_back({ this->Records.Key(record), record });
        }
        else
        {
          this->Take(record, place++);
        }
      }
      if (!this->All.HasOrder)
      {
        part = Bytes();
      }
      progress.Check();
    }
    sortByKey(records, progress);
    for (const Sorted& record : records)
    {
      this->Take(record.Record, place++);
    }
  }

  void Take(const char* record, std::int64_t place)
  {
    this->Records.ReadPoint(record, this->Points.data() + 3 * place);
    if (this->All.HasMasses)
    {
      this->Masses.data()[place] = this->Records.Mass(record);
    }
  }

  struct Sorted
  {
    std::int64_t Key;
    const char* Record;
  };

  const SplatParticles<D, Real> Own;
  const std::int64_t* const Order;
  const SplatTarget& Target;
  const Agreement& All;
  const PointRecords<Real> Records;
  const Ranks& Processes;
  std::vector<Bytes> Parts; // for each rank
  LargeBuffer<Real> Points; // that reach the box of this rank, in order
  LargeBuffer<double> Masses;
};

// The points of this rank.
template <class Real>
struct OwnPoints
{
  ConstPointSpan<3, Real> Points;
  const double* Masses;
  double MassEach;
  const std::int64_t* Order;
};

template <int D, class Real>
std::int64_t splatOnRanks(const OwnPoints<Real>& own, const SplatTarget& target,
  const Agreement& all, const Ranks& ranks, Progress& progress, double* cells)
{
  const SplatParticles<D, Real> particles{ own.Points, own.Masses, own.MassEach,
    target.Geometry.ToIndexMap<D>() };
  return DistributedSplat<D, Real>(particles, own.Order, target, all, ranks).Run(progress, cells);
}

template <class Real>
std::int64_t splatOwn(const OwnPoints<Real>& own, const SplatTarget& target, const Agreement& all,
  const Ranks& ranks, Progress& progress, double* cells)
{
  const auto splat = dispatchDimension(target.Geometry.Dimension(), splatOnRanks<1, Real>,
    splatOnRanks<2, Real>, splatOnRanks<3, Real>);
  return splat(own, target, all, ranks, progress, cells);
}

} // namespace

std::int64_t splatDistributed(vtkDataArray* points, const double* masses, double massEach,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells)
{
  const Ranks& ranks = progress.Group();
  if (!ranks.AreSeveral())
  {
    return splatPoints(points, masses, massEach, target, progress, cells);
  }
  const vtkIdType count = points->GetNumberOfTuples();
  auto* single = vtkAOSDataArrayTemplate<float>::FastDownCast(points);
  const Agreement all = agreementOf(
    { wanted, count, single != nullptr, masses != nullptr, order != nullptr, massEach }, ranks);
  Stages stages(progress, { { "points", all.IsSingle ? 0.0 : 5.0 }, { "splat", 95 } });
  const double bytes = 100.0 * static_cast<double>(count);
  return withMemory("the exchange of " + std::to_string(count) + " points", bytes, [&]() {
    if (all.IsSingle)
    {
      return splatOwn<float>(
        { { single ? single->GetPointer(0) : nullptr, count }, masses, massEach, order }, target,
        all, ranks, stages["splat"], cells->GetPointer(0));
    }
    const DoubleTuples doubles(points, stages["points"]);
    return splatOwn<double>({ { doubles.data(), count }, masses, massEach, order }, target, all,
      ranks, stages["splat"], cells->GetPointer(0));
  });
}

} // namespace RectifiedTransport::Bridge
