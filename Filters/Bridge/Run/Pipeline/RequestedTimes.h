// SPDX-License-Identifier: BSD-3-Clause
// The algorithms upstream of an algorithm, and the times that are requested from them.
#ifndef RectifiedTransport_RequestedTimes_h
#define RectifiedTransport_RequestedTimes_h

#include "Bridge/VTKCompatibility.h"

#include <map>
#include <optional>
#include <set>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

using Algorithms = std::set<vtkAlgorithm*>;

// An algorithm and all that it depends on.
Algorithms upstreamOf(vtkAlgorithm* algorithm);

// The times that the information of an output announces; none without times.
struct TimeRange
{
  double First;
  double Last;
  int Steps; // 0 where any time between these may be requested

  bool operator==(const TimeRange& other) const
  {
    return this->First == other.First && this->Last == other.Last && this->Steps == other.Steps;
  }
};
std::optional<TimeRange> announcedTimes(vtkInformation* output);

// The same of the first output that has times.
std::optional<TimeRange> timesOf(vtkAlgorithm* algorithm);

// The times that are requested from all outputs upstream of an algorithm. They are restored at the
// end: another consumer may have requested them and not have received the data yet.
class RequestedTimes
{
public:
  explicit RequestedTimes(vtkAlgorithm* algorithm);
  ~RequestedTimes();

  RequestedTimes(const RequestedTimes&) = delete;
  RequestedTimes& operator=(const RequestedTimes&) = delete;

private:
  std::map<vtkInformation*, std::optional<double>> Times; // the requested time of each output
};

} // namespace RectifiedTransport::Bridge

#endif
