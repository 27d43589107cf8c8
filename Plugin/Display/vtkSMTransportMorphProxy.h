// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMTransportMorphProxy
 * @brief   a morph that publishes its times alone
 *
 * The XML element TransportMorphProxy. With PublishTime on, the morph's inputs stay at their first
 * time. The session's TimeKeeper then ignores the times of all sources upstream, so that the scene
 * has the times of the morph only. With PublishTime off, or when the morph is deleted, it takes
 * them into account again, except those that ParaView itself ignores, which are the inputs of a
 * filter that has times of its own.
 *
 * The user's choice of sources in the window's list of times comes first: a source that was ignored
 * before PublishTime was on stays so, and one that is chosen again afterwards is not ignored again.
 *
 * @sa vtkSMTimeKeeperProxy
 */
#ifndef vtkSMTransportMorphProxy_h
#define vtkSMTransportMorphProxy_h

#include "Display/vtkSMTransportStateProxy.h"

#include "vtkWeakPointer.h"

#include <map>
#include <set>

class vtkSMTimeKeeperProxy;

class vtkSMTransportMorphProxy : public vtkSMTransportStateProxy
{
public:
  static vtkSMTransportMorphProxy* New();
  vtkTypeMacro(vtkSMTransportMorphProxy, vtkSMTransportStateProxy);

  void UpdateVTKObjects() override;

  /**
   * Takes the times of the sources upstream into account again.
   */
  void RestoreTimes();

protected:
  vtkSMTransportMorphProxy() = default;
  ~vtkSMTransportMorphProxy() override;

private:
  vtkSMTransportMorphProxy(const vtkSMTransportMorphProxy&) = delete;
  void operator=(const vtkSMTransportMorphProxy&) = delete;

  void SetIgnored(const std::set<vtkSMProxy*>& sources);

  vtkWeakPointer<vtkSMTimeKeeperProxy> TimeKeeper;
  // Upstream since PublishTime is on; whether their times have to come back.
  std::map<vtkWeakPointer<vtkSMProxy>, bool> Ignored;
  // Unknown at first: a state has the sources that are ignored because of the morph.
  enum class Publishing
  {
    Unknown,
    Off,
    On
  };
  Publishing State = Publishing::Unknown;
};

#endif
