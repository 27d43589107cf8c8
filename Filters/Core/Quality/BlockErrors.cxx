// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/BlockErrors.h"

#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace RectifiedTransport
{

namespace
{

void keepLargest(std::vector<double>& values, std::int64_t count)
{
  if (static_cast<std::int64_t>(values.size()) > count)
  {
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(values.begin(), end, values.end(), std::greater<>());
    values.resize(static_cast<std::size_t>(count));
  }
}

} // namespace

std::vector<double> countedOf(std::vector<double> errors)
{
  errors.erase(
    std::remove_if(errors.begin(), errors.end(), [](double e) { return e < 0.0; }), errors.end());
  return errors;
}

// Each rank sends its `count` largest values only; the largest of all are among them.
std::vector<double> largestOf(std::vector<double> own, std::int64_t count, const Ranks& ranks)
{
  keepLargest(own, count);
  std::vector<double> largest;
  for (const Bytes& bytes : ranks.Gather(toBytes(own)))
  {
    const auto part = fromBytes<double>(bytes);
    largest.insert(largest.end(), part.begin(), part.end());
  }
  keepLargest(largest, count);
  return largest;
}

BlockErrors largestErrors(std::vector<double> own, const Ranks& ranks)
{
  const auto all = sumOverRanks(ranks, static_cast<std::int64_t>(own.size()));
  // The values from the quantile on number n - floor(0.999 n) = ceil(n / 1000), in integers.
  const std::vector<double> largest = largestOf(std::move(own), (all + 999) / 1000, ranks);
  if (all == 0)
  {
    return {};
  }
  const auto [least, most] = std::minmax_element(largest.begin(), largest.end());
  return { *least, *most };
}

} // namespace RectifiedTransport
