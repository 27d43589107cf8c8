// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are several times of one source. The executive passes the requests of all inputs
// upstream before any data are made: the source would make those of the last request alone, and all
// inputs would get them. Filters that keep data, as vtkForceTime does, would keep the wrong ones.
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
class vtkInformation;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Of one filter.
class SeparateInputs
{
public:
  SeparateInputs();
  ~SeparateInputs();

  // Of inputs that share a source, but not its times: requests of each the first of the source's
  // times, or the nearest that the input has. Without a request the source would make those of the
  // last one, for all of them.
  static void RequestFirstTimes(vtkAlgorithm* filter, vtkInformationVector** inputVector);

  // From REQUEST_UPDATE_EXTENT, when the requests of the inputs are set: updates the inputs that
  // share a source with times, one after the other. The executive then finds all of them up to
  // date, and passes no request on. It depends on the pipeline alone, so that all ranks do the
  // same.
  void Update(vtkAlgorithm* filter, vtkInformationVector** inputVector);

  // In REQUEST_DATA: the executive's inputs, with what Update made in place of data that the
  // executive has made anew. Throws Failure where an input could not be made.
  vtkInformationVector** Inputs(vtkAlgorithm* filter, vtkInformationVector** inputVector);
  // Releases what Update made.
  void End();

private:
  using Output = std::pair<vtkAlgorithm*, int>; // of a filter, by its port
  struct Branch;
  struct Made
  {
    int Port;
    int Index;
    vtkSmartPointer<vtkDataObject> Data; // the producer's own
    vtkMTimeType Time;                   // of its last update
    vtkSmartPointer<vtkDataObject> Copy;
  };
  // The modification time of a filter, and the time of the data of an output that has one only.
  using State = std::pair<vtkMTimeType, std::optional<double>>;

  static std::vector<Branch> FindBranches(vtkAlgorithm* filter, vtkInformationVector** inputVector);
  static std::set<Output> WrongOutputs(const std::vector<Branch>& branches);
  static State StateOf(const Output& output);
  void UpdateEach(const std::vector<Branch>& branches);
  void ForgetKeptSteps(const std::vector<Branch>& branches);
  bool ForgetWrongTimes(const std::vector<Branch>& branches);

  std::vector<Made> Data;
  std::string Failed;             // the error message; empty where all inputs were made
  std::map<Output, State> Untold; // whose data have another time even if made alone

  std::map<vtkAlgorithm*, vtkMTimeType> Keepers; // of steps, and when their data were made last

  // What replaces the executive's inputs.
  std::vector<vtkSmartPointer<vtkInformationVector>> Vectors;
  std::vector<vtkInformationVector*> Pointers;
};

} // namespace RectifiedTransport

#endif
