// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities, of which those are kept that the next call needs.
#ifndef RectifiedTransport_DensityDistances_h
#define RectifiedTransport_DensityDistances_h

#include "Bridge/Distance/DistanceInput.h"
#include "Core/Distance/CertifiedDistance.h"
#include "Core/Distance/ReferenceImages.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// As in vtkTransportDistance.
enum class DistanceMethod
{
  Linearized,
  Certified
};

// In physical lengths.
struct DistancePair
{
  double Distance = 0.0;
  double Lower = 0.0;
  double Upper = 0.0;
};

// Densities are added one after the other, so that few need memory at a time, then Find. Keeps maps
// and distances by the content of the densities, whatever their order and their names. Ranks divide
// maps and pairs among them.
class DensityDistances
{
public:
  // Forgets the densities, but not what was computed.
  void Begin(DistanceMethod method);
  // With Linearized, may compute maps. Collective. Throws Failure, where densities have not the
  // same box, and Cancelled.
  void Add(DistanceInput input, Progress& progress);
  const std::vector<DistanceInput>& Inputs() const { return this->Given; }

  // How many maps and pairs of Certified have been found, on all ranks.
  std::int64_t NumberOfSolutions() const { return this->Solutions; }

  // The pairs (0, 1), (0, 2) ... (1, 2) ... of the densities. Collective. Throws Failure and
  // Cancelled.
  std::vector<DistancePair> Find(Progress& progress);

private:
  using KeyPair = std::pair<DensityKey, DensityKey>;

  template <int D>
  void MakeMaps(Progress& progress);
  template <int D>
  std::vector<DistancePair> FindAll(Progress& progress);
  template <int D>
  SquaredBracket FindPair(const KeyPair& pair, const Context& context) const;
  template <int D>
  void FindMissing(Progress& progress);
  void KeepOnlyGiven();
  std::vector<KeyPair> MissingPairs() const;
  template <int D>
  std::array<double, D> Sides() const;

  std::int64_t Solutions = 0;
  DistanceMethod Method = DistanceMethod::Linearized;
  std::vector<DistanceInput> Given;
  std::vector<std::size_t> Waiting; // inputs of which there is no map yet
  std::map<DensityKey, std::shared_ptr<const ReferenceImages>> Maps;
  std::array<std::map<KeyPair, SquaredBracket>, 2> Pairs; // by method, in squared LengthScale units
};

} // namespace RectifiedTransport::Bridge

#endif
