// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCollectiveAlgorithm
 * @brief   superclass of all filters of the module
 *
 * Where there are several ranks, all of them run a filter together, on data that are whole, in
 * pieces, or gathered, as its ports say. The parallel loops take the threads of Threading: results
 * are the same to the last bit for every number of threads and of ranks.
 *
 * Passes the executive's requests to virtual methods. An exception that they throw becomes one
 * error of the filter; after an error or an abort all outputs are empty, and the whole extents of
 * images are empty, too.
 *
 * @sa vtkDensityAlgorithm vtkEqualMassCells
 */
#ifndef vtkCollectiveAlgorithm_h
#define vtkCollectiveAlgorithm_h

#include "Bridge/VTKCompatibility.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro
#include "vtkTransportEnumerations.h"

#include <map>    // for the gathered ports
#include <memory> // for std::unique_ptr
#include <string> // for texts
#include <vector> // for several texts

namespace RectifiedTransport
{
class Ranks;
namespace Bridge
{
class ProducerUpdate;
class RankRun;
class InputRequests;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;

class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkCollectiveAlgorithm : public vtkTransportEnumerations
{
public:
  vtkTypeMacro(vtkCollectiveAlgorithm, vtkTransportEnumerations);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What runs the parallel loops: VTK (vtkSMPTools with the backend in use), OpenMP, or Serial.
   * Auto (default) is OpenMP where VTK's backend is Sequential, else VTK. A child that fork() made
   * is always Serial, as it has none of its parent's threads. It changes the time, never the
   * result.
   */
  vtkSetMacro(Threading, int);
  vtkGetMacro(Threading, int);
  void SetThreadingToAuto() { this->SetThreading(THREADING_AUTO); }
  void SetThreadingToVTK() { this->SetThreading(THREADING_VTK); }
  void SetThreadingToOpenMP() { this->SetThreading(THREADING_OPENMP); }
  void SetThreadingToSerial() { this->SetThreading(THREADING_SERIAL); }
  const char* GetThreadingAsString();
  ///@}

  ///@{
  /**
   * Set a data object as an input, without a pipeline connection.
   */
  void SetInputData(vtkDataObject* input) { this->SetInputData(0, input); }
  void SetInputData(int port, vtkDataObject* input);
  ///@}

  /**
   * For state files with the former name of a property, where ParaView's client has no plugin that
   * converts them: warn if they have a value. `names` is "Now was called Former".
   */
  void WarnOfFormerProperty(const char* names, const char* value);

  /**
   * Pass the executive's requests to the methods below.
   */
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Whether the last run ended with an error. Its outputs are empty then, and the executive goes on
   * with the filters downstream.
   */
  bool HasFailed() const { return this->Failed; }

  /**
   * Whether an input port must be connected. VTK takes a second one for optional all the same: its
   * lack is then one error of the run, and not several of the executive.
   */
  bool NeedsInput(int port);

  /**
   * After an abort, run again at the next update, which would find the outputs up to date.
   */
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int outputPort, vtkMTimeType* time) override;

protected:
  vtkCollectiveAlgorithm();
  ~vtkCollectiveAlgorithm() override;

  /**
   * Make the output data objects. By default the executive makes them, of the types of the ports;
   * an output of the type vtkPointSet is of the type of the first input, or a vtkPolyData while
   * there is no input.
   */
  virtual int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Set what is known of the outputs before the data; the times of all inputs are set already. By
   * default nothing. A Failure is reported by RequestData; here whole extents become empty.
   */
  virtual int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Update the producer of an input from RequestInformation: where the extent of an image follows
   * from points or cells, image filters downstream would otherwise get no data, or read past the
   * end of an image that is smaller than announced. Where the points change with time,
   * RequestInformation is called again for the time that is requested downstream.
   *
   * The port is partitioned or gathered: where there are several ranks, all of them meet here, and
   * each updates its own piece. Returns the ranks, so that all announce the same; GetRanks returns
   * them, too, until RequestInformation returns. If ranks do not meet in time, or execute blocks,
   * this process runs alone and updates all data.
   */
  const RectifiedTransport::Ranks& UpdateInputOnRanks(int port, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int connection = 0);

  /**
   * What the filter needs of an input port. By default all data: whole images, because a transport
   * is global, and all points. With several ranks, all of them run the filter together if a port is
   * partitioned or gathered.
   */
  enum PortPolicyType
  {
    PORT_WHOLE,               // all data, on each rank
    PORT_PIECES,              // the requested piece, each by itself
    PORT_PARTITIONED_POINTS,  // each rank has its own piece of the points
    PORT_PARTITIONED_DENSITY, // each rank has its own piece of a density of any type
    PORT_GATHERED_POINTS,     // partitioned ones, gathered on the first rank, which alone runs
                              // RequestData
    PORT_GATHERED_SURFACE,    // the same
    PORT_GATHERED_DENSITY     // the same
  };

  /**
   * How many data objects an input port takes.
   */
  enum PortInputsType
  {
    PORT_ONE_INPUT,
    PORT_OPTIONAL_INPUT,
    PORT_SEVERAL_INPUTS
  };

  /**
   * For a constructor: one more input port, and the types of data that it takes. If a port is
   * gathered, all are that are not whole. The other ranks then have empty outputs with the field
   * data of the first rank's, and what ShareOutputs gives them.
   */
  void AddInputPort(PortPolicyType policy, const std::vector<const char*>& types,
    PortInputsType inputs = PORT_ONE_INPUT);

  /**
   * For a constructor: one more output port, and the type of its data.
   */
  void AddOutputPort(const char* type);

  ///@{
  /**
   * The constructor has done so.
   */
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  ///@}

  /**
   * Whether RequestData runs on the first rank alone, of data that are gathered.
   */
  bool RunsForAllRanks() const { return this->IsAlone; }

  /**
   * Divide what RequestData made on the first rank among all of them. Collective. By default
   * nothing.
   */
  virtual void ShareOutputs(
    const RectifiedTransport::Ranks& ranks, vtkInformationVector* outputVector);

  /**
   * The ranks that run RequestData together; one rank where this process runs it alone.
   */
  const RectifiedTransport::Ranks& GetRanks() const;

  ///@{
  /**
   * Warn, of several ranks on the first one only. Each text is a warning of its own; an empty one
   * is none.
   */
  void WarnOnFirstRank(const std::string& text);
  void WarnOnFirstRank(const std::vector<std::string>& texts);
  ///@}

  /**
   * Choose the time to request from the inputs. By default it is the one that is requested
   * downstream.
   */
  virtual int RequestUpdateTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Request of each port what its policy says. Inputs that are partial nevertheless, as other data
   * distributed over ranks, are an error before RequestData.
   */
  virtual int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Request the whole extent, or piece 0 of 1, of all connections of a port.
   */
  static void RequestWhole(vtkInformationVector* port);

  /**
   * Fill the outputs. An exception becomes one error and empty outputs, an abort empty outputs.
   * Without other ranks piece 0 holds all data of a filter whose inputs have no pieces: for other
   * pieces this is not called, and the outputs are empty.
   *
   * If it calls RequestNextPass, RequestUpdateExtent is called again, the input of port 0 is
   * updated and RequestData called once more.
   */
  virtual int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  /**
   * For RequestData: run once more, of other data. With CONTINUE_EXECUTING VTK's executives do so
   * for other filters, but never end where a filter upstream fails meanwhile (VTK 9.1 to 9.6).
   */
  void RequestNextPass() { this->HasNextPass = true; }

  /**
   * Begin anew with the next pass: there was an error or an abort. By default nothing.
   */
  virtual void EndPasses();

  int Threading = THREADING_AUTO;

private:
  vtkTypeBool ProcessCaught(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int ProcessWithoutSecond(vtkInformation* request, vtkInformationVector* outputVector);
  int ProcessInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int ProcessTimeDependentInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int ProcessData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int ProcessPass(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int GatherAndRun(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int MakeOutputs(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  void EndRun();
  bool IsLaterPiece(vtkInformation* request, vtkInformationVector* outputVector);
  std::unique_ptr<RectifiedTransport::Bridge::InputRequests> Whole;
  std::unique_ptr<RectifiedTransport::Bridge::ProducerUpdate> Early;
  std::unique_ptr<RectifiedTransport::Bridge::RankRun>
    Run; // during RequestData and RequestInformation
  bool HasNextPass = false;
  bool WasAborted = false;
  bool NeedsSecond = false; // input, on port 1
  bool Failed = false;
  std::map<int, PortPolicyType> Gathered; // by port; none where ranks share the work
  bool IsAlone = false;                   // on the first rank, with gathered data

  vtkCollectiveAlgorithm(const vtkCollectiveAlgorithm&) = delete;
  void operator=(const vtkCollectiveAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
