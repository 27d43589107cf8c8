// SPDX-License-Identifier: BSD-3-Clause
// The discrete cosine transform of the first kind of lines of nodes, eight at a time.
#ifndef RectifiedTransport_CosineTransform_h
#define RectifiedTransport_CosineTransform_h

#include "Core/Grid/Lanes.h"
#include "Core/Parallel/LargeBuffer.h"

#include <complex>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace RectifiedTransport
{

// X(k) = f(0) + (-1)^k f(M) + 2 sum over 0 < j < M of f(j) cos(pi j k / M), for lines of M + 1
// nodes and an even M. Twice it is 2 M times the identity. The same bits on every machine. For one
// thread at a time.
class CosineLines
{
public:
  static constexpr int Count = 2 * Lanes::Count;
  using Complex = std::complex<Lanes>;

  explicit CosineLines(std::int64_t cells);
  ~CosineLines();

  // Node j of all lines: real parts are lines 0 to 3, imaginary parts 4 to 7.
  Complex* Nodes() { return this->Line.data(); }
  double* Values() { return reinterpret_cast<double*>(this->Line.data()); }

  // Transforms the lines in place.
  void Transform();

  // Bytes for lines of so many cells.
  static double MemoryFor(std::int64_t cells);

private:
  struct Plan;

  std::int64_t Cells;
  std::unique_ptr<Plan> Fourier;
  std::vector<double> Cosines; // cos(pi j / M) for j up to M / 2
  std::vector<double> Sines;   // sin(pi j / M)
  LargeBuffer<Complex> Line;
  LargeBuffer<Complex> Spectrum;
};

// Lends each thread its own object and takes it back.
class CosineLinesPool
{
public:
  explicit CosineLinesPool(std::int64_t cells)
    : Cells(cells)
  {
  }

  // Calls work(lines). Throws std::bad_alloc.
  template <class Work>
  void With(const Work& work)
  {
    std::unique_ptr<CosineLines> lines = this->Take();
    work(*lines);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Free.push_back(std::move(lines));
  }

private:
  std::unique_ptr<CosineLines> Take()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (!this->Free.empty())
      {
        std::unique_ptr<CosineLines> lines = std::move(this->Free.back());
        this->Free.pop_back();
        return lines;
      }
    }
    return std::make_unique<CosineLines>(this->Cells);
  }

  std::int64_t Cells;
  std::mutex Mutex; // guards Free
  std::vector<std::unique_ptr<CosineLines>> Free;
};

} // namespace RectifiedTransport

#endif
