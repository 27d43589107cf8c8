// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDensityAlgorithm
 * @brief   superclass of the filters that read a density
 *
 * The density is an array of a data set, or of the data sets of a composite one, chosen with
 * SetInputArrayToProcess(0, ...), where the port is that of the image; without a choice it is
 * the active scalars of the points, else of the cells, else the only array, ids and flags aside.
 * That of a vtkImageData is piecewise constant on cells: cell arrays are taken as they are; the
 * values of a point array are those of the dual cells, so that the domain is the image's bounds
 * grown by half a spacing on each side of every axis. An axis of one point is no axis, so that
 * images may be 1D, 2D (in any coordinate plane) or 3D; one cell between two points is an axis
 * of one cell. Origin, spacing, extent and direction matrix are arbitrary, and so is the numeric
 * type. Cells and points that the ghost array marks as duplicate or hidden carry no mass, and
 * neither do the cells of a hidden point.
 *
 * Any other data set (rectilinear, structured and unstructured grids, polygons in one plane, closed
 * lines around regions of one, lines on one straight line), and any composite of data sets, is one
 * domain: an image on the bounds of
 * its cells of the highest dimension, with DensityResolution cells along the longest axis. The
 * value of a grid cell is the mean over it, 0 outside the data sets: point arrays are linear on the
 * simplices into which VTK divides the cells, cell arrays constant, cells that overlap add up.
 * Cells of a plane or line that is oblique get an image in it. Images that tile one lattice are
 * joined to one image instead, value by value, and cells of one lattice, as vtkThreshold leaves of
 * an image, are the image that they are of. The leaves of a vtkHyperTreeGrid are its cells. Blocks
 * without the array carry no mass, and those without cells, such as tables, are passed over; both
 * are a warning. Blanked cells and cells of AMR grids that finer ones
 * cover carry no mass. An input of surfaces that lie in no plane, or without cells of a measure, is
 * an error.
 *
 * Mass is physical: density times cell measure, which is the length, area or volume that the
 * image's axes of more than one point span.
 *
 * An array that is missing or of the wrong length, values that are NaN, infinite or (unless
 * NegativeValues is Clamp) negative, and a total mass of zero or past the largest double are
 * errors. The message names the array, how many values are wrong and the index of the first; the
 * output is then empty. An input without points gives an empty output without an error.
 *
 * The summed-area tables of a density are built when they are needed, and kept until it changes
 * (its values, ghost arrays, grid or the properties below), at a cost of O(cells) in time and of
 * about 21, 34 and 33 bytes a cell in 1D, 2D and 3D in memory. Filters that read the same values
 * share them; they are released with the last of these filters.
 *
 * @sa vtkTransportAlgorithm
 */
#ifndef vtkDensityAlgorithm_h
#define vtkDensityAlgorithm_h

#include "vtkGuardedAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
struct DensityChoice;
class FlowCache;
class ImageGrid;
class InputDensity;
class Progress;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkImageData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkDensityAlgorithm : public vtkGuardedAlgorithm
{
public:
  vtkTypeMacro(vtkDensityAlgorithm, vtkGuardedAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What NegativeValues may be.
   */
  enum NegativeValuesType
  {
    NEGATIVE_VALUES_ERROR = 0,
    NEGATIVE_VALUES_CLAMP = 1
  };

  ///@{
  /**
   * Which component of the array is the density: an index from 0, or -1 (default) for luminance.
   * The luminance of 3 or 4 components is 0.2126 R + 0.7152 G + 0.0722 B (Rec. 709), that of 1 or 2
   * the first one. The last of 2 or 4 components is alpha, and the picture is composited over
   * white: 255 for unsigned char, else the largest value of the array. An array of more than 4
   * components needs an index.
   */
  vtkSetMacro(Component, int);
  vtkGetMacro(Component, int);
  ///@}

  ///@{
  /**
   * Take (white - value) for the density, so that dark ink is mass. White is 255 for unsigned char,
   * else the largest value of the array (of the component, where Component is an index). Off by
   * default.
   */
  vtkSetMacro(InvertDensity, vtkTypeBool);
  vtkGetMacro(InvertDensity, vtkTypeBool);
  vtkBooleanMacro(InvertDensity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * What negative values of the density do: Error (default) stops with a message that counts them,
   * Clamp takes them as 0.
   */
  vtkSetMacro(NegativeValues, int);
  vtkGetMacro(NegativeValues, int);
  void SetNegativeValuesToError() { this->SetNegativeValues(NEGATIVE_VALUES_ERROR); }
  void SetNegativeValuesToClamp() { this->SetNegativeValues(NEGATIVE_VALUES_CLAMP); }
  const char* GetNegativeValuesAsString();
  ///@}

  ///@{
  /**
   * For inputs that are no images: the number of cells along the longest axis of the image that the
   * density is put on; along the others as many as make the cells nearest to cubes. From 1 to 2^30.
   * Default 256. Images, images that tile one lattice, and cell values of cells of one lattice are
   * taken as they are.
   */
  vtkSetMacro(DensityResolution, int);
  vtkGetMacro(DensityResolution, int);
  ///@}

  /**
   * The modification time of the density's tables: increases with each build, 0 before the first.
   */
  vtkMTimeType GetTableBuildTime();

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkDensityAlgorithm(int densityPort = 0);
  ~vtkDensityAlgorithm() override;

  /**
   * For FillInputPortInformation: the port takes any data sets, and composites of these as one.
   */
  static void FillDensityPortInformation(vtkInformation* info);

  /**
   * The grid of the density of an input, as far as its information object determines it before the
   * data; of data that are no images, those that are there. Without points where it is not known.
   * `number` is that of the input among those of the filter.
   */
  RectifiedTransport::ImageGrid AnnouncedDensityGrid(
    vtkInformation* inputInformation, int arrayIndex = 0, int number = 0);

  /**
   * The grid of the density of data that are there; without points if they have none. Throws what
   * RequestData may throw.
   */
  RectifiedTransport::ImageGrid FindDensityGrid(
    vtkDataObject* data, int arrayIndex = 0, int number = 0);

  /**
   * The density of a data object, input array `arrayIndex`; nullptr if it has no points. Of an
   * image that lies on several ranks it is the density of the whole one. Collective on the ranks of
   * the progress. Throws what RequestData may throw.
   */
  std::unique_ptr<RectifiedTransport::InputDensity> ReadDensity(vtkDataObject* input,
    RectifiedTransport::Progress& progress, int arrayIndex = 0, int number = 0);

  /**
   * The density on the constructor's port, input array 0; as above.
   */
  std::unique_ptr<RectifiedTransport::InputDensity> ReadDensity(
    vtkInformationVector** inputVector, RectifiedTransport::Progress& progress);

  /**
   * The tables that are kept between executions.
   */
  RectifiedTransport::FlowCache& GetFlowCache();

  int Component;
  vtkTypeBool InvertDensity;
  int NegativeValues;
  int DensityResolution;

private:
  vtkAbstractArray* FindDensityArray(vtkDataSet* data, int arrayIndex, int& association);
  bool IsDensityOnPoints(vtkInformation* inputInformation, int arrayIndex);
  RectifiedTransport::DensityChoice GetDensityChoice(int arrayIndex);

  const int DensityPort;
  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkDensityAlgorithm(const vtkDensityAlgorithm&) = delete;
  void operator=(const vtkDensityAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
