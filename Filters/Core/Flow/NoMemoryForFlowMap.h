// SPDX-License-Identifier: BSD-3-Clause
// Thrown if there is memory for the tables but not for a flow map. The run is possible without one
// (FlowMaps::Off).
#ifndef RectifiedTransport_NoMemoryForFlowMap_h
#define RectifiedTransport_NoMemoryForFlowMap_h

#include <new>

namespace RectifiedTransport
{

class NoMemoryForFlowMap : public std::bad_alloc
{
public:
  explicit NoMemoryForFlowMap(double bytes)
    : Bytes(bytes)
  {
  }
  const char* what() const noexcept override { return "no memory for a flow map"; }
  double MemorySize() const noexcept { return this->Bytes; } // bytes of the map

private:
  double Bytes;
};

} // namespace RectifiedTransport

#endif
