// SPDX-License-Identifier: BSD-3-Clause
// Which of other points each point becomes.
#ifndef PairPoints_h
#define PairPoints_h

#include <array>
#include <vector>

using Points = std::vector<std::array<double, 3>>;

// Pairs points of one set with points of another in the plane, the nearest two first, until one set
// is used up. Returns the partner of each point of `from`, -1 for none. The same for the same
// points, whatever ran before.
std::vector<int> pairPoints(const Points& from, const Points& to);

#endif
