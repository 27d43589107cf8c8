// SPDX-License-Identifier: BSD-3-Clause
// Each particle goes to the ranks whose cells its kernel reaches; these put what they receive in
// order and splat it onto their cells.
#include "Core/Splat/RankSplat.h"

#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Splat/SplatSetup.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A particle as it is sent. With its key, the receiver restores the order of all particles.
template <class Real>
struct SentParticle
{
  std::int64_t Key;
  double Mass;
  Real Place[3];
};

// Returns whether a kernel from the cells `first` on, with `kept` cells an axis, reaches a part.
template <int Dimension>
bool reaches(
  const LatticePart<Dimension>& part, const std::int32_t* first, const std::int32_t* kept)
{
  bool isReached = !part.IsEmpty();
  for (int a = 0; a < Dimension; ++a)
  {
    // Half-open ranges of cells overlap along every axis.
    isReached = isReached && first[a] < part.End(a) && first[a] + kept[a] > part.Low[a];
  }
  return isReached;
}

// The particles that a rank sends to each rank, and how many of its own are outside.
template <class Real>
struct Sent
{
  std::vector<std::vector<SentParticle<Real>>> ToRanks;
  std::int64_t Outside = 0;
};

// A particle at the border of parts goes to several ranks; each adds only to its own cells.
template <int Dimension, class Real>
Sent<Real> distribute(const SplatSetup<Dimension, Real>& setup, const std::int64_t* keys,
  const std::vector<LatticePart<Dimension>>& wanted, Progress& progress)
{
  // Blocks bound the array of cells; particles are visited in order, so that each rank receives
  // them in the order of their numbers.
  constexpr int block = 1024;
  const SplatParticles<Dimension, Real>& particles = setup.Job.Particles;
  Sent<Real> sent;
  sent.ToRanks.resize(wanted.size());
  std::vector<std::int32_t> cells(3 * block);
  progress.ForInOrder(particles.Points.size(), block, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t first = begin; first < end; first += block)
    {
      const int count = static_cast<int>(std::min<std::int64_t>(block, end - first));
      sent.Outside += setup.Kernels.Find(setup.Job, first, count, cells.data());
      for (int i = 0; i < count; ++i)
      {
        const std::int64_t particle = first + i;
        SentParticle<Real> record;
        // Equal keys keep the order of ranks and particles, because the sort is stable.
        record.Key = keys ? keys[particle] : 0;
        record.Mass = particles.Masses ? particles.Masses[particle] : particles.Mass;
        std::copy_n(particles.Points[particle], 3, record.Place);
        for (std::size_t rank = 0; rank < wanted.size(); ++rank)
        {
          if (reaches<Dimension>(wanted[rank], cells.data() + 3 * i, setup.Job.Span))
          {
            sent.ToRanks[rank].push_back(record);
          }
        }
      }
    }
  });
  return sent;
}

// The particles of all ranks that reach this one, in the order of their keys. The exchange gives
// them by rank and index, and the sort by keys is stable.
template <class Real>
class ReceivedParticles
{
public:
  ReceivedParticles(
    std::vector<std::vector<SentParticle<Real>>> sent, const Ranks& ranks, Progress& progress)
  {
    std::vector<std::vector<SentParticle<Real>>> received = exchangeValues(ranks, std::move(sent));
    std::size_t number = 0;
    for (const std::vector<SentParticle<Real>>& part : received)
    {
      number += part.size();
    }
    std::vector<SentParticle<Real>> all;
    all.reserve(number);
    for (std::vector<SentParticle<Real>>& part : received)
    {
      all.insert(all.end(), part.begin(), part.end());
      part = {};
      progress.Check();
    }
    sortByKey(all, progress);
    const auto count = static_cast<std::int64_t>(all.size());
    // The splat takes coordinates and masses in separate arrays.
    this->Places = LargeBuffer<Real>(3 * count);
    this->Masses = LargeBuffer<double>(count);
    Real* place = this->Places.data();
    double* mass = this->Masses.data();
    for (const SentParticle<Real>& particle : all)
    {
      place = std::copy_n(particle.Place, 3, place);
      *mass++ = particle.Mass;
    }
  }

  ConstPointSpan<3, Real> Points() const { return { this->Places.data(), this->Masses.size() }; }
  const double* MassesOfPoints() const { return this->Masses.data(); }

private:
  LargeBuffer<Real> Places;
  LargeBuffer<double> Masses;
};

} // namespace

template <int Dimension, class Real>
std::int64_t splatOnRanks(const SplatParticles<Dimension, Real>& particles,
  const std::int64_t* keys, const GridSize<Dimension>& size, const LatticePart<Dimension>& wanted,
  const SplatOptions& options, double scale, double* cells, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  Stages stages(progress, { { "exchange", 2 }, { "splat", 8 } });
  // The keys count only if every rank with particles has them.
  const bool haveKeys = onAllRanks(ranks, keys || particles.Points.size() == 0);
  const SplatSetup<Dimension, Real> setup(particles, size, options);
  Sent<Real> sent = distribute<Dimension, Real>(
    setup, haveKeys ? keys : nullptr, gatherValues(ranks, wanted), stages["exchange"]);
  const ReceivedParticles<Real> received(std::move(sent.ToRanks), ranks, stages["exchange"]);
  // Every rank adds the particles that reach its cells in the global order, so a cell has the
  // bits of a serial sum.
  splatMass<Dimension, Real>(
    { received.Points(), received.MassesOfPoints(), 0.0, particles.ToIndex }, size, wanted, options,
    scale, cells, stages["splat"]);
  return sumOverRanks(ranks, sent.Outside);
}

template decltype(splatOnRanks<1, float>) splatOnRanks<1, float>;
template decltype(splatOnRanks<2, float>) splatOnRanks<2, float>;
template decltype(splatOnRanks<3, float>) splatOnRanks<3, float>;
template decltype(splatOnRanks<1, double>) splatOnRanks<1, double>;
template decltype(splatOnRanks<2, double>) splatOnRanks<2, double>;
template decltype(splatOnRanks<3, double>) splatOnRanks<3, double>;

} // namespace RectifiedTransport
