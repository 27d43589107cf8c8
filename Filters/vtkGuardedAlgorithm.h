// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGuardedAlgorithm
 * @brief   what all filters of the module share as algorithms
 *
 * Chooses who runs the parallel loops: results are the same to the last bit for every number of
 * threads and every setting of Threading.
 *
 * Passes the executive's requests to virtual methods. What they throw becomes one error of the
 * filter; after an error or an abort all outputs are empty, and images announce no extent.
 *
 * @sa vtkDensityAlgorithm vtkEqualMassCells
 */
#ifndef vtkGuardedAlgorithm_h
#define vtkGuardedAlgorithm_h

#include "Bridge/VTKCompatibility.h"
#include "vtkAlgorithm.h"
#include "vtkRectifiedTransportModule.h" // for the export macro
#include "vtkWeakPointer.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCompositeDataSet;
class vtkDataObject;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkGuardedAlgorithm : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkGuardedAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Threading may be.
   */
  enum ThreadingType
  {
    THREADING_AUTO = 0,
    THREADING_VTK = 1,
    THREADING_OPENMP = 2,
    THREADING_SERIAL = 3
  };

  ///@{
  /**
   * Who runs the parallel loops: VTK (vtkSMPTools with the backend in use), OpenMP, or Serial. Auto
   * (default) is OpenMP where VTK's backend is Sequential, else VTK. It changes the time, never the
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
   * Give an input as a data object, without a pipeline that makes it.
   */
  void SetInputData(vtkDataObject* input) { this->SetInputData(0, input); }
  void SetInputData(int port, vtkDataObject* input);
  ///@}

  /**
   * Pass the executive's requests to the methods below.
   */
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkGuardedAlgorithm();
  ~vtkGuardedAlgorithm() override;

  /**
   * Make the outputs that do not exist yet, of the type that the port's information names.
   */
  virtual int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Make the point set of an output port of the type of an input, where it is not; polydata while
   * there is none.
   */
  static void MakeOutputLike(
    vtkInformationVector* input, vtkInformationVector* outputVector, int port);

  /**
   * Publish what is known before the data, beside the times of all inputs. By default nothing. What
   * the user can put right is left to RequestData to say: the images are then announced as empty.
   */
  virtual int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Bring what is connected to a port up to date, from RequestInformation: where the extent of an
   * image follows from points, image filters behind it would otherwise get nothing, or read past
   * the end of an image that is smaller than announced. Where the points change with time,
   * RequestInformation is called again for the time that a consumer asks for.
   */
  void UpdateInputBeforeData(
    int port, vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  /**
   * Whether the filter needs all of an input port: whole images, because a transport is global, and
   * all points. By default yes; if not, the pieces that are asked for are passed on.
   */
  virtual bool NeedsWhole(int port);

  /**
   * Choose the time that the inputs are asked for. By default it is the one that a consumer asks
   * for.
   */
  virtual int RequestUpdateTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Ask for the whole of the ports that NeedsWhole names. Data that are less all the same, as those
   * that lie on several ranks, are an error before RequestData.
   */
  virtual int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);

  /**
   * Ask for the whole of all that is connected to a port.
   */
  static void RequestWhole(vtkInformationVector* port);

  /**
   * Whether a consumer asks for a piece after the first, which has all that there is. The executive
   * marks all outputs with the piece that one of them is asked for.
   */
  static bool IsLaterPiece(vtkInformation* request, vtkInformationVector* outputVector);

  /**
   * Make the outputs. What is thrown here becomes one error and empty outputs, an abort empty
   * outputs.
   */
  virtual int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  int Threading;

private:
  int Inform(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int InformOfTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  void NoteRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  vtkCompositeDataSet* CompositeAt(int port, int connection); // nullptr where there is none
  bool IsAtBlock(vtkInformationVector** inputVector);
  void RequireWhole(vtkInformationVector** inputVector);

  // What is asked for, and the composites on the input ports: while the executive goes through
  // their blocks it shows one block at a time, of which the whole is asked for.
  int AskedPiece = 0;
  int AskedNumberOfPieces = 1;
  std::vector<std::vector<vtkWeakPointer<vtkCompositeDataSet>>> Composites;
  vtkMTimeType Compared = 0;             // with other ranks: how new the inputs were
  std::vector<std::uint64_t> Agreed;     // the fingerprints of the ports on which ranks agreed
  std::string Disagreement;              // what came of it, if not agreement
  const vtkAlgorithm* Updated = nullptr; // before the data; compared, never used
  int UpdatedPort = 0;
  vtkMTimeType UpdatedTime = 0;

  vtkGuardedAlgorithm(const vtkGuardedAlgorithm&) = delete;
  void operator=(const vtkGuardedAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
