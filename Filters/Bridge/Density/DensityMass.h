// SPDX-License-Identifier: BSD-3-Clause
// The mass of a density where no tables are built, which would find it.
#ifndef RectifiedTransport_DensityMass_h
#define RectifiedTransport_DensityMass_h

namespace RectifiedTransport
{

class InputDensity;
class Progress;

// Density times cell measure, summed: of a density that is prepared, as the work of the current
// stage. Tells of values that are probably not meant. Throws Failure for a sum whose mass is no
// double, and Cancelled; values that are wrong, which the core counts, make the result meaningless.
double massOf(InputDensity& density, Progress& progress);

} // namespace RectifiedTransport

#endif
