// SPDX-License-Identifier: BSD-3-Clause
// What a filter requests from its inputs: all data or, on a partitioned port, this rank's piece of
// distributed data. Rejects other distributed inputs, for which results would be wrong.
#ifndef RectifiedTransport_InputRequests_h
#define RectifiedTransport_InputRequests_h

#include "Bridge/Run/Inputs/SeparateInputs.h"
#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkCompositeDataSet;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class RankRun;

// For one filter. Remembers the last comparison with other ranks, so that data that do not change
// are compared once.
class InputRequests
{
public:
  // Exempts a port; all others are needed whole.
  void Except(int port) { this->Excepted.insert(port); }
  bool IsNeeded(int port) const { return this->Excepted.count(port) == 0; }
  bool HasPieces() const { return !this->Excepted.empty(); }
  // Takes pieces of the points on a port, or of any data, if the filter runs on all ranks.
  void Partition(int port, bool takesPoints) { this->Partitioned[port] = takesPoints; }

  // Records the requested piece and the composite inputs in REQUEST_UPDATE_EXTENT. While the
  // executive iterates over blocks, it replaces the input by one block at a time and requests piece
  // 0 of 1.
  void Record(vtkAlgorithm* filter, vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  // Requests the rank's own piece of what is partitioned.
  void RequestPartitioned(int port, vtkInformationVector* inputs) const;
  // Requests from all outputs the piece that is requested from one. Otherwise the executive makes
  // an image whole that is not requested itself, and then treats all outputs as made for the
  // requested piece.
  void RequestOutputs(vtkInformation* request, vtkInformationVector* outputs) const;

  // As SeparateInputs, except while the executive iterates over blocks: the producer of a block
  // must not run. If no time is requested from the outputs, the first times are requested from the
  // inputs.
  void RequestFirstTimes(vtkAlgorithm* filter, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) const;
  void UpdateSeparately(
    vtkAlgorithm* filter, vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  SeparateInputs& Separate() { return this->Separated; }

  // The execution of a filter of partitioned inputs, on all ranks; nullptr if this process runs it
  // alone. As RankRun::Begin.
  std::unique_ptr<RankRun> BeginRun(vtkAlgorithm* filter, vtkInformationVector** inputVector) const;
  // The same in REQUEST_INFORMATION, for a port that is partitioned.
  std::unique_ptr<RankRun> BeginWithoutPieces(
    vtkAlgorithm* filter, int port, vtkInformationVector** inputVector) const;

  // On the ports that are needed whole: throws Failure for an image whose extent is smaller than
  // its WHOLE_EXTENT, and for data that are not the same on all ranks; warns if other ranks do not
  // answer.
  void Require(vtkAlgorithm* filter, vtkInformationVector** inputVector, const RankRun* run);

private:
  using Inputs = std::vector<std::vector<vtkDataObject*>>; // by port and connection

  vtkCompositeDataSet* CompositeAt(int port, int connection) const; // nullptr for none
  bool IsIteratingOverBlocks(vtkAlgorithm* filter, vtkInformationVector** inputVector) const;
  bool IsPartitioned(int port, vtkInformation* input) const;
  bool Compare(vtkAlgorithm* filter, const Inputs& inputs);

  std::set<int> Excepted;
  std::map<int, bool> Partitioned; // whether only points
  bool Iterates = false; // the executive, over blocks; each rank runs alone for each block
  SeparateInputs Separated;
  int Piece = 0;
  int NumberOfPieces = 1;
  // By port and connection.
  std::vector<std::vector<vtkWeakPointer<vtkCompositeDataSet>>> Composites;
  vtkMTimeType ComparedTime = 0;   // the newest modification time of the inputs
  std::vector<std::uint64_t> Same; // the fingerprints of the ports; empty if ranks differed
  std::string Difference;          // the error message; empty if ranks agreed
};

} // namespace RectifiedTransport::Bridge

#endif
