// SPDX-License-Identifier: BSD-3-Clause
// How a filter of particles and a density reads the density at first: as the particles' field data
// say, where the density has their array. The element ReadAsParticles is among the hints of such a
// filter, whose inputs are Input and Density.
#ifndef RectifiedTransport_ParticleReading_h
#define RectifiedTransport_ParticleReading_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkSMProxy;

namespace RectifiedTransport
{

// The properties of a reading that nobody has set since `time`; none of other proxies.
std::vector<std::string> unsetReading(vtkSMProxy* filter, vtkMTimeType time);

// Sets these properties. Updates the particles if they never were.
void readAsParticles(vtkSMProxy* filter, const std::vector<std::string>& properties);

} // namespace RectifiedTransport

#endif
