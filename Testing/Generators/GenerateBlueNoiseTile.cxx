// SPDX-License-Identifier: BSD-3-Clause
// Generates BlueNoiseTile2D.inc and BlueNoiseTile3D.inc, the toroidal point sets of
// SeedPattern::BlueNoise. Not part of the build: half a minute in 2D and three in 3D, in the folder
// Testing/Generators, with the core built as Contributing.md says and Eigen 3.4 in EIGEN:
//
//   CORE=$PWD/../../build-core/lib TILE=../../Filters/Core/Seeds/BlueNoiseTile
//   g++ -O2 -std=c++17 -ffp-contract=off -I. -I../../Filters -I$EIGEN -L$CORE -Wl,-rpath,$CORE
//     -o generate GenerateBlueNoiseTile.cxx -lRectifiedTransportCore
//   ./generate 2 ${TILE}2D.inc
//   ./generate 3 ${TILE}3D.inc
//
// The result is the same on every machine: only + - * / and sqrt of IEEE doubles are used.
// Method: points repel each other by a Gaussian, which removes the low frequencies of their
// spectrum and keeps them amorphous; a second stage adds a spring between points nearer than a
// chosen distance, which raises the smallest spacings. With a narrower Gaussian they would
// crystallise.
//
// A third stage, in 2D, lowers the mean squared distance of the plane from the nearest point: the
// points move to the centroids of the cells of equal areas that cost least (de Goes, Breeden,
// Ostromoukhov and Desbrun, "Blue Noise through Optimal Transport", ACM Transactions on Graphics
// 31(6), 2012), and those that come too near are pushed apart. Many such moves would crystallise
// them in patches: there are as few as the tests' goals need.
#include "TorusPartition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace
{

// Lengths are in units of the mean spacing: one point a unit of area or volume.
template <int Dimension>
struct Settings;

template <>
struct Settings<2>
{
  static constexpr int NumberOfPoints = 4096;
  static constexpr double Side = 64.0;
  static constexpr double LargestSpacing = 1.0745699318235419; // of the hexagonal lattice
  static constexpr double Sigma = 0.95;
  static constexpr double SmallestSpacing = 0.896; // relative to the largest possible
  static constexpr int Iterations = 2000;          // of each of the first two stages
  static constexpr int Moves = 12;                 // of the third
  static constexpr double LeastSpacing = 0.88;     // as SmallestSpacing, of the third
  static constexpr std::uint64_t RandomSeed = 1;
};

template <>
struct Settings<3>
{
  static constexpr int NumberOfPoints = 4096;
  static constexpr double Side = 16.0;
  static constexpr double LargestSpacing = 1.1224620483093730; // of the face-centred cubic lattice
  static constexpr double Sigma = 0.636;                       // of Relax Blue Noise
  static constexpr double SmallestSpacing = 0.86;
  static constexpr int Iterations = 2000;
  static constexpr std::uint64_t RandomSeed = 1;
};

constexpr double SpringStiffness = 2.0;
// Where the Gaussian is cut, in sigmas. Much nearer, and its spectrum is no longer positive where
// it matters: points would cluster.
constexpr double Cut = 6.0;

// exp(-x) for 0 <= x <= 18 to ten digits, without the machine's library.
double decay(double x)
{
  const double y = -x / 64.0;
  double sum = 1.0;
  for (int n = 9; n >= 1; --n)
  {
    sum = 1.0 + y * sum / n;
  }
  for (int squaring = 0; squaring < 6; ++squaring)
  {
    sum *= sum;
  }
  return sum;
}

class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : State(seed)
  {
  }
  double operator()()
  {
    this->State += 0x9E3779B97F4A7C15u;
    std::uint64_t z = this->State;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

private:
  std::uint64_t State;
};

template <int Dimension>
using Vector = std::array<double, Dimension>;

template <int Dimension>
class Relaxation
{
  using Set = Settings<Dimension>;
  using VectorType = Vector<Dimension>;

public:
  Relaxation()
    : Positions(Set::NumberOfPoints)
    , Velocities(Set::NumberOfPoints)
    , Forces(Set::NumberOfPoints)
  {
    RandomNumbers random(Set::RandomSeed);
    for (VectorType& position : this->Positions)
    {
      for (double& coordinate : position)
      {
        coordinate = Set::Side * random();
      }
    }
  }

  std::vector<std::array<std::uint16_t, Dimension>> Run()
  {
    this->Minimise(0.0, "repulsion");
    this->Minimise(Set::SmallestSpacing * Set::LargestSpacing, "spacing");
    if constexpr (Dimension == 2)
    {
      this->MoveToCentroids();
    }
    return this->Quantise();
  }

  // The distances of nearest neighbours, relative to the largest possible: smallest and mean.
  std::array<double, 2> Spacing(std::vector<VectorType> positions)
  {
    this->Positions.swap(positions);
    this->FindNeighbours(2.5);
    std::vector<double> nearest(Set::NumberOfPoints, Set::Side * Set::Side);
    this->VisitPairs([&](int i, int j, const VectorType&, double squared) {
      nearest[i] = std::min(nearest[i], squared);
      nearest[j] = std::min(nearest[j], squared);
    });
    double smallest = Set::Side;
    double sum = 0.0;
    for (double squared : nearest)
    {
      const double distance = std::sqrt(squared) / Set::LargestSpacing;
      smallest = std::min(smallest, distance);
      sum += distance;
    }
    this->Positions.swap(positions);
    return { smallest, sum / Set::NumberOfPoints };
  }

  static std::vector<VectorType> Dequantise(
    const std::vector<std::array<std::uint16_t, Dimension>>& points)
  {
    std::vector<VectorType> positions(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (int a = 0; a < Dimension; ++a)
      {
        positions[i][a] = points[i][a] * (Set::Side / 65536.0);
      }
    }
    return positions;
  }

private:
  // Fast inertial relaxation (Bitzek et al. 2006): velocities are reset when the energy rises.
  void Minimise(double springLength, const char* stage)
  {
    const double reach = Cut * Set::Sigma;
    const double skin = 0.5;
    double timeStep = 0.05;
    double steering = 0.1;
    int descending = 0;
    double moved = skin;
    std::fill(this->Velocities.begin(), this->Velocities.end(), VectorType{});
    for (int iteration = 0; iteration < Set::Iterations; ++iteration)
    {
      if (moved >= skin / 2.0)
      {
        this->FindNeighbours(reach + skin);
        moved = 0.0;
      }
      this->ComputeForces(springLength);
      double power = 0.0;
      double force = 0.0;
      double speed = 0.0;
      for (int i = 0; i < Set::NumberOfPoints; ++i)
      {
        for (int a = 0; a < Dimension; ++a)
        {
          power += this->Forces[i][a] * this->Velocities[i][a];
          force += this->Forces[i][a] * this->Forces[i][a];
          speed += this->Velocities[i][a] * this->Velocities[i][a];
        }
      }
      if (power > 0.0)
      {
        if (++descending > 5)
        {
          timeStep = std::min(1.1 * timeStep, 1.0);
          steering *= 0.99;
        }
      }
      else
      {
        descending = 0;
        timeStep *= 0.5;
        steering = 0.1;
        speed = 0.0;
        std::fill(this->Velocities.begin(), this->Velocities.end(), VectorType{});
      }
      moved += this->Step(timeStep, steering, force > 0.0 ? std::sqrt(speed / force) : 0.0);
      if ((iteration + 1) % 500 == 0)
      {
        std::fprintf(stderr, "%s %d: force %.2e\n", stage, iteration + 1,
          std::sqrt(force / Set::NumberOfPoints));
      }
    }
  }

  void MoveToCentroids()
  {
    RectifiedTransport::TorusPartition partition(Set::Side);
    for (int move = 0; move < Set::Moves; ++move)
    {
      partition.Solve(this->Positions);
      std::fprintf(stderr, "transport %d: cost %.5f\n", move, partition.MeanSquare());
      for (int i = 0; i < Set::NumberOfPoints; ++i)
      {
        this->Move(i, partition.CellMoments()[i].First); // areas are 1
      }
      this->Separate();
    }
  }

  // Pushes each pair that is too near apart, a few times, as others may come too near.
  void Separate()
  {
    constexpr int sweeps = 8;
    const double least = Set::LeastSpacing * Set::LargestSpacing;
    this->FindNeighbours(1.5 * Set::LargestSpacing);
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      std::fill(this->Forces.begin(), this->Forces.end(), VectorType{});
      this->VisitPairs([&](int i, int j, const VectorType& offset, double squared) {
        const double distance = std::sqrt(squared);
        const double push = distance < least ? 0.5 * (least - distance) / distance : 0.0;
        for (int a = 0; a < Dimension; ++a)
        {
          this->Forces[i][a] += push * offset[a];
          this->Forces[j][a] -= push * offset[a];
        }
      });
      for (int i = 0; i < Set::NumberOfPoints; ++i)
      {
        this->Move(i, this->Forces[i]);
      }
    }
  }

  // On the torus, by less than its side.
  void Move(int i, const VectorType& step)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      double& x = this->Positions[i][a];
      x += step[a];
      x = x < 0.0 ? x + Set::Side : x;
      x = x >= Set::Side ? x - Set::Side : x;
    }
  }

  // Moves the points and returns the largest distance any of them moved.
  double Step(double timeStep, double steering, double forceToSpeed)
  {
    double largest = 0.0;
    for (int i = 0; i < Set::NumberOfPoints; ++i)
    {
      VectorType step;
      double squared = 0.0;
      for (int a = 0; a < Dimension; ++a)
      {
        double& velocity = this->Velocities[i][a];
        velocity =
          (1.0 - steering) * velocity + (steering * forceToSpeed + timeStep) * this->Forces[i][a];
        step[a] = std::min(std::max(timeStep * velocity, -0.1), 0.1);
        squared += step[a] * step[a];
      }
      this->Move(i, step);
      largest = std::max(largest, squared);
    }
    return std::sqrt(largest);
  }

  void ComputeForces(double springLength)
  {
    std::fill(this->Forces.begin(), this->Forces.end(), VectorType{});
    const double sigmaSquared = Set::Sigma * Set::Sigma;
    this->VisitPairs([&](int i, int j, const VectorType& offset, double squared) {
      double strength = 0.0;
      if (squared < Cut * Cut * sigmaSquared)
      {
        strength = decay(squared / (2.0 * sigmaSquared)) / sigmaSquared;
      }
      if (squared < springLength * springLength)
      {
        const double distance = std::sqrt(squared);
        strength += 2.0 * SpringStiffness * (springLength - distance) / distance;
      }
      for (int a = 0; a < Dimension; ++a)
      {
        this->Forces[i][a] += strength * offset[a];
        this->Forces[j][a] -= strength * offset[a];
      }
    });
  }

  template <class F>
  void VisitPairs(F&& visit) const
  {
    for (int i = 0; i < Set::NumberOfPoints; ++i)
    {
      for (int j : this->Neighbours[i])
      {
        VectorType offset;
        visit(i, j, offset, this->Offset(i, j, offset));
      }
    }
  }

  // The shortest offset from j to i on the torus; returns its squared length.
  double Offset(int i, int j, VectorType& offset) const
  {
    double squared = 0.0;
    for (int a = 0; a < Dimension; ++a)
    {
      double d = this->Positions[i][a] - this->Positions[j][a];
      d = d > Set::Side / 2.0 ? d - Set::Side : d;
      d = d < -Set::Side / 2.0 ? d + Set::Side : d;
      offset[a] = d;
      squared += d * d;
    }
    return squared;
  }

  // Each pair once, in the list of its larger index, by a grid of cells of at least half the reach.
  void FindNeighbours(double reach)
  {
    const int cells = static_cast<int>(2.0 * Set::Side / reach);
    std::vector<std::vector<int>> members(this->Power(cells));
    std::vector<std::array<int, Dimension>> places(Set::NumberOfPoints);
    for (int i = 0; i < Set::NumberOfPoints; ++i)
    {
      int cell = 0;
      for (int a = Dimension - 1; a >= 0; --a)
      {
        places[i][a] =
          std::min(static_cast<int>(this->Positions[i][a] * cells / Set::Side), cells - 1);
        cell = cell * cells + places[i][a];
      }
      members[cell].push_back(i);
    }
    this->Neighbours.assign(Set::NumberOfPoints, {});
    for (int i = 0; i < Set::NumberOfPoints; ++i)
    {
      for (int k = 0; k < this->Power(5); ++k)
      {
        int cell = 0;
        int digits = k;
        for (int a = Dimension - 1; a >= 0; --a)
        {
          cell = cell * cells + (places[i][a] + digits % 5 - 2 + cells) % cells;
          digits /= 5;
        }
        for (int j : members[cell])
        {
          VectorType offset;
          if (j < i && this->Offset(i, j, offset) < reach * reach)
          {
            this->Neighbours[i].push_back(j);
          }
        }
      }
    }
  }

  static int Power(int base)
  {
    int result = 1;
    for (int a = 0; a < Dimension; ++a)
    {
      result *= base;
    }
    return result;
  }

  // In Morton order, so that the points of every dyadic cube of the tile are contiguous.
  std::vector<std::array<std::uint16_t, Dimension>> Quantise() const
  {
    std::vector<std::array<std::uint16_t, Dimension>> points(Set::NumberOfPoints);
    for (int i = 0; i < Set::NumberOfPoints; ++i)
    {
      for (int a = 0; a < Dimension; ++a)
      {
        const double scaled = std::floor(this->Positions[i][a] * (65536.0 / Set::Side) + 0.5);
        points[i][a] = static_cast<std::uint16_t>(static_cast<int>(scaled) % 65536);
      }
    }
    const auto morton = [](const std::array<std::uint16_t, Dimension>& point) {
      std::uint64_t code = 0;
      for (int bit = 15; bit >= 0; --bit)
      {
        for (int a = Dimension - 1; a >= 0; --a)
        {
          code = code << 1 | (point[a] >> bit & 1u);
        }
      }
      return code;
    };
    std::sort(points.begin(), points.end(),
      [&](const auto& left, const auto& right) { return morton(left) < morton(right); });
    return points;
  }

  std::vector<VectorType> Positions;
  std::vector<VectorType> Velocities;
  std::vector<VectorType> Forces;
  std::vector<std::vector<int>> Neighbours;
};

template <int Dimension>
int writeTile(const char* fileName)
{
  Relaxation<Dimension> relaxation;
  const auto points = relaxation.Run();
  const auto spacing = relaxation.Spacing(Relaxation<Dimension>::Dequantise(points));
  std::FILE* file = std::fopen(fileName, "w");
  if (!file)
  {
    std::fprintf(stderr, "cannot write %s\n", fileName);
    return EXIT_FAILURE;
  }
  std::fprintf(file,
    "// SPDX-License-Identifier: BSD-3-Clause\n// Generated by "
    "Testing/Generators/GenerateBlueNoiseTile.cxx: do not edit.\n"
    "// Nearest neighbours, relative to the largest possible spacing: smallest %.4f, mean %.4f.\n",
    spacing[0], spacing[1]);
  std::size_t column = 0;
  for (const auto& point : points)
  {
    for (std::uint16_t coordinate : point)
    {
      char text[8];
      std::snprintf(text, sizeof(text), "%u,", static_cast<unsigned>(coordinate));
      if (column + std::strlen(text) > 100)
      {
        std::fputc('\n', file);
        column = 0;
      }
      std::fputs(text, file);
      column += std::strlen(text);
    }
  }
  std::fputc('\n', file);
  std::fprintf(stderr, "spacing: smallest %.4f, mean %.4f\n", spacing[0], spacing[1]);
  return std::fclose(file) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int argc, char* argv[])
{
  const int dimension = argc == 3 ? std::atoi(argv[1]) : 0;
  if (dimension == 2 || dimension == 3)
  {
    return dimension == 2 ? writeTile<2>(argv[2]) : writeTile<3>(argv[2]);
  }
  std::fprintf(stderr, "usage: %s 2|3 file\n", argv[0]);
  return EXIT_FAILURE;
}
