// SPDX-License-Identifier: BSD-3-Clause
// The mass of a density for which no tables are built.
#ifndef RectifiedTransport_DensityMass_h
#define RectifiedTransport_DensityMass_h

namespace RectifiedTransport
{
class DensityValues;
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

// Density times cell measure, summed, for a prepared density. Reports values that are probably not
// meant. Throws Failure if the mass is beyond the largest double, and Cancelled. If there are wrong
// values, which the core counts, the result is meaningless.
double massOf(InputDensity& density, Progress& progress);
// The same for a density whose values may be distributed over ranks and have been gathered. Wrong
// values throw Failure. Collective.
double requireMass(InputDensity& density, const DensityValues& gathered, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
