// SPDX-License-Identifier: BSD-3-Clause
// Points, and non-owning views of arrays of them.
#ifndef RectifiedTransport_Points_h
#define RectifiedTransport_Points_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace RectifiedTransport
{

template <int Dimension>
using Point = std::array<double, Dimension>;

template <int Dimension>
Point<Dimension> pointAt(const double* coordinates)
{
  Point<Dimension> point;
  std::copy_n(coordinates, Dimension, point.begin());
  return point;
}

// `size()` points of Dimension interleaved coordinates. Functions do not keep a span that they
// take.
template <int Dimension, class Real = double>
class PointSpan
{
public:
  PointSpan() = default;
  PointSpan(Real* coordinates, std::int64_t count)
    : First(coordinates)
    , Count(count)
  {
  }
  // The points of a std::vector or std::array of Point<Dimension>.
  template <class Container,
    class = std::enable_if_t<
      std::is_convertible_v<decltype(std::declval<Container&>().data()->data()), Real*> &&
      sizeof(*std::declval<Container&>().data()) == Dimension * sizeof(Real)>>
  PointSpan(Container&& points)
    : First(points.empty() ? nullptr : points.data()->data())
    , Count(static_cast<std::int64_t>(points.size()))
  {
  }
  // From writable to const points.
  template <class Other, class = std::enable_if_t<std::is_convertible_v<Other (*)[], Real (*)[]>>>
  PointSpan(const PointSpan<Dimension, Other>& other)
    : First(other.data())
    , Count(other.size())
  {
  }

  Real* data() const { return this->First; }
  std::int64_t size() const { return this->Count; }
  Real* operator[](std::int64_t point) const { return this->First + point * Dimension; }
  PointSpan Part(std::int64_t first, std::int64_t count) const { return { (*this)[first], count }; }

private:
  Real* First = nullptr;
  std::int64_t Count = 0;
};

template <int Dimension, class Real = double>
using ConstPointSpan = PointSpan<Dimension, const Real>;

} // namespace RectifiedTransport

#endif
