// SPDX-License-Identifier: BSD-3-Clause
// What a filter of particles and a density begins with: the density that the particles come from,
// read as their field data say, where it has their array. The element ReadAsParticles is among the
// hints of such a filter, whose inputs are Input and Density.
#ifndef RectifiedTransport_ParticleReading_h
#define RectifiedTransport_ParticleReading_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkSMProxy;

namespace RectifiedTransport
{

// Gives a filter without a Density that of the particles.
void takeDensityOfParticles(vtkSMProxy* filter);

// The properties of a reading that nobody has set since `time`; of ParaView's Histogram, which
// takes the first array by name, its array; none of other proxies.
std::vector<std::string> unsetReading(vtkSMProxy* filter, vtkMTimeType time);

// Sets these properties. Updates the particles if they never were.
void readAsParticles(vtkSMProxy* filter, const std::vector<std::string>& properties);

} // namespace RectifiedTransport

#endif
