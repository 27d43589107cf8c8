// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are several times of one source. VTK's executive passes the requests of all inputs
// upstream before any data are made. The source would make only the data of the last request, and
// all inputs would get them. Filters that keep data, such as vtkForceTime, would keep the wrong
// ones. Without this, TestSeparateInputs.cxx fails with VTK 9.2 (ParaView 5.11); with it, the tests
// pass with VTK 9.1 to 9.6 (README, Versions tested).
#ifndef RectifiedTransport_SeparateInputs_h
#define RectifiedTransport_SeparateInputs_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// For one filter.
class SeparateInputs
{
public:
  SeparateInputs();
  ~SeparateInputs();

  // For inputs that share a source but not its times: requests from each input the first of the
  // source's times, or the nearest time that the input has. Without a request, the source would
  // make the data of the last request for all of them.
  static void RequestFirstTimes(vtkAlgorithm* filter, vtkInformationVector** inputVector);

  // Called in REQUEST_UPDATE_EXTENT, when the requests of the inputs are set: updates the inputs
  // that share a source with times, one after the other. The executive then finds them up to date
  // and passes no request on. This depends only on the pipeline, so that all ranks do the same.
  void Update(vtkAlgorithm* filter, vtkInformationVector** inputVector);

  // In REQUEST_DATA: the executive's inputs, with the data from Update instead of data that the
  // executive has made again. Throws Failure if an input could not be made.
  vtkInformationVector** Inputs(vtkAlgorithm* filter, vtkInformationVector** inputVector);
  // Releases what Update made.
  void End();

private:
  using Output = std::pair<vtkAlgorithm*, int>; // a filter and its output port
  struct Branch;
  struct UpdatedInput
  {
    int Port;
    int Index;
    vtkSmartPointer<vtkDataObject> Data; // the producer's own
    vtkMTimeType Time;                   // when it was updated last
    vtkSmartPointer<vtkDataObject> Copy;
  };
  // The modification time of a filter, and the time of the data if an output has only one.
  using State = std::pair<vtkMTimeType, std::optional<double>>;

  static std::vector<Branch> FindBranches(vtkAlgorithm* filter, vtkInformationVector** inputVector);
  static std::set<Output> Mistimed(const std::vector<Branch>& branches);
  static State StateOf(const Output& output);
  void UpdateEach(const std::vector<Branch>& branches);
  void InvalidateCachedSteps(const std::vector<Branch>& branches);
  bool DropMistimed(const std::vector<Branch>& branches);

  std::vector<UpdatedInput> Data;
  std::string Failed;                     // the error message; empty if all inputs were made
  std::map<Output, State> UntimedOutputs; // whose data have another time even if made separately

  // Filters that keep steps, and when their data were made last.
  std::map<vtkAlgorithm*, vtkMTimeType> CachingFilters;
  std::vector<vtkSmartPointer<vtkInformationVector>> Vectors;
  std::vector<vtkInformationVector*> Pointers;
};

} // namespace RectifiedTransport::Bridge

#endif
