// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceSampling/SamplePatches.h"

#include "Core/Parallel/Stages.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The relative noise of independent samples in a patch is 1 / sqrt(64) = 0.125: an error well above
// that means wrong masses.
constexpr double samplesOfPatch = 64.0;

// A k-d tree over the centres of triangles in space. Triangles are not divided, so that a patch may
// have more mass than wanted.
class PatchTree
{
public:
  PatchTree(const DiskMesh& disk, const double* masses)
    : Masses(masses)
    , Patches(static_cast<std::size_t>(disk.NumberOfTriangles()), 0)
  {
    const ConstPointSpan<3> points = disk.Surface().Points;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (int i = 0; i < 3; ++i)
      {
        centre += Eigen::Map<const Eigen::Vector3d>(points[disk.Triangle(t)[i]]) / 3.0;
      }
      this->Items.push_back({ centre, t });
      this->Total += masses[t];
    }
  }

  // Numbers the patches. Each has at most `largest` of the mass, unless it is one triangle. A cut
  // halves the triangles, not the mass.
  void Divide(double largest, Progress& progress)
  {
    std::vector<std::pair<std::size_t, std::size_t>> left{ { 0, this->Items.size() } };
    while (!left.empty())
    {
      const auto [first, last] = left.back();
      left.pop_back();
      double mass = 0.0;
      Eigen::AlignedBox3d bounds;
      for (std::size_t i = first; i < last; ++i)
      {
        mass += this->Masses[this->Items[i].Triangle];
        bounds.extend(this->Items[i].Centre);
      }
      progress.Add(static_cast<std::int64_t>(last - first));
      // One triangle is not divided.
      if (last - first == 1 || mass <= largest)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          this->Patches[static_cast<std::size_t>(this->Items[i].Triangle)] = this->Expected.size();
        }
        // A leaf is a patch.
        this->Expected.push_back(mass / this->Total);
        continue;
      }
      Eigen::Index axis = 0;
      bounds.sizes().maxCoeff(&axis);
      // Halves by number; ties by number of triangle, so that patches are the same everywhere.
      const std::size_t middle = first + (last - first) / 2;
      const auto at = [this](std::size_t i) {
        return this->Items.begin() + static_cast<std::ptrdiff_t>(i);
      };
      std::nth_element(at(first), at(middle), at(last), [axis](const Item& a, const Item& b) {
        return std::make_pair(a.Centre[axis], a.Triangle) <
          std::make_pair(b.Centre[axis], b.Triangle);
      });
      left.push_back({ first, middle });
      left.push_back({ middle, last });
    }
  }

  double TotalMass() const { return this->Total; }

  // sqrt(sum over patches of (share of samples - share of mass)^2 / sum of (share of mass)^2).
  double Error(const LargeBuffer<PlaceOnTriangle>& places) const
  {
    std::vector<double> found(this->Expected.size(), 0.0);
    const double each = 1.0 / static_cast<double>(places.size());
    for (std::int64_t i = 0; i < places.size(); ++i)
    {
      // The share of the samples in the patch.
      found[this->Patches[static_cast<std::size_t>(places.data()[i].Triangle)]] += each;
    }
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t patch = 0; patch < found.size(); ++patch)
    {
      difference += std::pow(found[patch] - this->Expected[patch], 2);
      size += std::pow(this->Expected[patch], 2);
    }
    return std::sqrt(difference / size);
  }

private:
  struct Item
  {
    Eigen::Vector3d Centre;
    std::int64_t Triangle;
  };

  const double* Masses; // by triangles
  std::vector<Item> Items;
  std::vector<std::size_t> Patches; // by triangles
  std::vector<double> Expected;     // by patches, the share of the mass
  double Total = 0.0;
};

} // namespace

double patchError(const DiskMesh& disk, const double* masses,
  const LargeBuffer<PlaceOnTriangle>& places, const Context& context)
{
  if (places.size() == 0)
  {
    return 0.0;
  }
  Progress progress(context);
  // Each level of the tree reads all triangles; about log2(patches) levels.
  const double patches = std::max(static_cast<double>(places.size()) / samplesOfPatch, 1.0);
  Stages stages(progress, { { "patches", 9 }, { "error", 1 } });
  Progress& division = stages["patches"].Expect(static_cast<std::int64_t>(
    (2.0 + std::log2(patches)) * static_cast<double>(disk.NumberOfTriangles())));
  PatchTree tree(disk, masses);
  tree.Divide(tree.TotalMass() / patches, division);
  const double error = tree.Error(places);
  stages["error"].EndSlice(1);
  return error;
}

} // namespace RectifiedTransport
