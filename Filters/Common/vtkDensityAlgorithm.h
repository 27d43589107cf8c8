// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDensityAlgorithm
 * @brief   superclass of the filters that read a density
 *
 * The density is an array of a data set, or of the data sets of a composite one. Choose it with
 * SetInputArrayToProcess(0, ...) and the port of the data. Without a choice it is the active
 * scalars of the points, else those of the cells, else the only array that is neither ids nor
 * flags. Text that holds numbers alone is a density where it is chosen by its name.
 *
 * The density of a vtkImageData is piecewise constant on cells. Cell arrays are used as they are.
 * The values of a point array are those of the dual cells: the domain is the image's bounds plus
 * half a spacing on each side of every axis. An axis of one point is no axis: images may be 1D, 2D
 * (in any coordinate plane) or 3D. One cell between two points is an axis of one cell. Origin,
 * spacing, extent, direction matrix and numeric type are arbitrary. Cells and points that the ghost
 * array marks as duplicate or hidden carry no mass. The cells of a hidden point carry no mass
 * either.
 *
 * Any other data set and any composite of data sets is one domain. It may be a rectilinear,
 * structured or unstructured grid, polygons in one plane, closed lines around regions of a plane,
 * or lines on one straight line. It is resampled to an image on the bounds of its cells of the
 * highest dimension, with DensityResolution cells along the longest axis. The value of a grid cell
 * is the mean over it, 0 outside the data sets. Point arrays are linear on the simplices into which
 * VTK divides the cells. Cell arrays are constant. Cells that overlap add up. Cells in an oblique
 * plane or line get an image in it.
 *
 * Polygons of a vtkPolyData that lie in no plane must be a closed surface. The density is then what
 * vtkSolidDensity makes of it, on its bounds with DensityResolution cells: 1 inside and 0 outside.
 * No array is read.
 *
 * Images that tile one lattice are joined to one image instead, value by value. Cells of one
 * lattice, for example what vtkThreshold leaves of an image, become that image again. The leaves of
 * a vtkHyperTreeGrid are its cells. Blocks without the array carry no mass. Blocks without cells,
 * such as tables, are ignored. Both give a warning. Blanked cells and AMR cells covered by finer
 * ones carry no mass. Other surfaces that lie in no plane, and inputs without cells of positive
 * measure, are errors.
 *
 * Mass is physical: density times cell measure. The measure is the length, area or volume that the
 * image's axes of more than one point span.
 *
 * NaNValues and ValidRange say which values mark missing data. The cells of such values are empty
 * and carry no mass, as blanked ones.
 *
 * These are errors: an array that is missing or has the wrong length; other values that are NaN,
 * infinite or, unless NegativeValues is Clamp, negative; a total mass of zero or beyond the largest
 * double. The message gives the name of the array, the number of wrong values and the index of the
 * first one. The output is then empty. An input without points gives an empty output and no error.
 *
 * The summed-area tables of a density are built when they are needed. They are kept until the
 * density changes: its values, ghost arrays, grid or the properties below. They take O(cells) time
 * and about 21, 34 and 33 bytes a cell in 1D, 2D and 3D. Filters that read the same values share
 * them; the last of these filters releases them.
 *
 * @sa vtkTransportAlgorithm
 */
#ifndef vtkDensityAlgorithm_h
#define vtkDensityAlgorithm_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
class ImageGrid;
class Progress;
namespace Bridge
{
struct DensityChoice;
class FlowCache;
class InputDensity;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkImageData;

class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkDensityAlgorithm : public vtkCollectiveAlgorithm
{
public:
  vtkTypeMacro(vtkDensityAlgorithm, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What NegativeValues may be.
   */
  enum NegativeValuesType
  {
    NEGATIVE_VALUES_ERROR = 0,
    NEGATIVE_VALUES_CLAMP = 1
  };

  /**
   * What Component may be besides an index.
   */
  enum ComponentType
  {
    COMPONENT_AUTO = -1,
    COMPONENT_LUMINANCE = -2,
    COMPONENT_MAGNITUDE = -3
  };

  ///@{
  /**
   * The component of the array that is the density: an index from 0, -1 (Auto), -2
   * (luminance) or -3 (magnitude). Auto takes the luminance of unsigned integers of 8 or 16 bits,
   * as photographs have them, and the magnitude of all other arrays of several components. With 3
   * or 4 components the luminance is 0.2126 R + 0.7152 G + 0.0722 B (Rec. 709); with 2 it is the
   * first component. The last of 2 or 4 components is alpha: the picture is composited over white,
   * which is 255 for unsigned char, else the largest value of the array. More than 4 components
   * have no luminance. The magnitude is the Euclidean norm of all components. The field data
   * DensityComponent of the output are the choice that was taken. Default -1.
   */
  vtkSetMacro(Component, int);
  vtkGetMacro(Component, int);
  ///@}

  ///@{
  /**
   * Use (white - value) as the density, so that dark ink is mass. White is 255 for unsigned char,
   * else the largest value of the array (of the component, if Component is an index). With the
   * magnitude, it is the largest magnitude. Off by default.
   */
  vtkSetMacro(InvertDensity, vtkTypeBool);
  vtkGetMacro(InvertDensity, vtkTypeBool);
  vtkBooleanMacro(InvertDensity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * What to do with negative values. Error (default): stop with a message that counts them. Clamp:
   * use 0.
   */
  vtkSetMacro(NegativeValues, int);
  vtkGetMacro(NegativeValues, int);
  void SetNegativeValuesToError() { this->SetNegativeValues(NEGATIVE_VALUES_ERROR); }
  void SetNegativeValuesToClamp() { this->SetNegativeValues(NEGATIVE_VALUES_CLAMP); }
  const char* GetNegativeValuesAsString();
  ///@}

  /**
   * What NaNValues may be.
   */
  enum NaNValuesType
  {
    NAN_VALUES_ERROR = 0,
    NAN_VALUES_EMPTY = 1
  };

  ///@{
  /**
   * What NaN is. Error (default): stop with a message that counts them. Empty: it marks missing
   * data; the cell is empty, as a blanked one is. NaN in any component of a colour
   * or of the magnitude counts. In data other than images, the cells of a point whose value is
   * missing are empty, too.
   */
  vtkSetMacro(NaNValues, int);
  vtkGetMacro(NaNValues, int);
  void SetNaNValuesToError() { this->SetNaNValues(NAN_VALUES_ERROR); }
  void SetNaNValuesToEmpty() { this->SetNaNValues(NAN_VALUES_EMPTY); }
  const char* GetNaNValuesAsString();
  ///@}

  ///@{
  /**
   * The smallest and the largest valid value of the array. Values outside mark missing data: their
   * cells are empty. Values are compared as they are in the array, before InvertDensity: each
   * component of a colour except alpha, and each component of the magnitude. An end of 1e299 or
   * more, of either sign, is no bound; infinite values are then errors. Default -1e+299 1e+299.
   */
  vtkSetVector2Macro(ValidRange, double);
  vtkGetVector2Macro(ValidRange, double);
  ///@}

  ///@{
  /**
   * For inputs other than images: the number of cells along the longest axis of the image that the
   * density is resampled to, from 1 to 2^30. Default 256. The numbers along the other axes make the
   * cells as near to cubes as possible. Images, images that tile one lattice, and cell values of
   * cells of one lattice are used as they are.
   */
  vtkSetMacro(DensityResolution, int);
  vtkGetMacro(DensityResolution, int);
  ///@}

  /**
   * The modification time of the density's tables. It increases with each build and is 0 before the
   * first.
   */
  vtkMTimeType GetTableBuildTime();

  /**
   * Whether the density's input, as it is now, is polygons that lie in no plane, so that no array
   * of it is read.
   */
  int IsInputAroundSolid();

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkDensityAlgorithm(int densityPort = 0);
  ~vtkDensityAlgorithm() override;

  /**
   * For a constructor: one more input port, which takes any data set, and a composite as one data
   * set.
   */
  void AddDensityPort(PortPolicyType policy, PortInputsType inputs = PORT_ONE_INPUT);

  /**
   * The grid of the density of an input, as its information object announces it before the data. If
   * the data are not an image, the grid of the data that are there. It has no points if it is not
   * known. `number` is the number of the input among those of the filter.
   */
  RectifiedTransport::ImageGrid AnnouncedDensityGrid(
    vtkInformation* inputInformation, int arrayIndex = 0, int number = 0);

  /**
   * The grid of the density of data that are there. It has no points if the data have none. Throws
   * what RequestData may throw.
   */
  RectifiedTransport::ImageGrid FindDensityGrid(
    vtkDataObject* data, int arrayIndex = 0, int number = 0);

  /**
   * The density of a data object, input array `arrayIndex`; nullptr if the object has no points. If
   * an image is distributed over ranks, this is the density of the whole image. Collective on the
   * ranks of the progress. Throws what RequestData may throw.
   */
  std::unique_ptr<RectifiedTransport::Bridge::InputDensity> ReadDensity(vtkDataObject* input,
    RectifiedTransport::Progress& progress, int arrayIndex = 0, int number = 0);

  /**
   * The same for the density on the constructor's port, input array 0.
   */
  std::unique_ptr<RectifiedTransport::Bridge::InputDensity> ReadDensity(
    vtkInformationVector** inputVector, RectifiedTransport::Progress& progress);

  /**
   * The tables that are kept between executions.
   */
  RectifiedTransport::Bridge::FlowCache& GetFlowCache();

  int Component = COMPONENT_AUTO;
  vtkTypeBool InvertDensity = false;
  int NegativeValues = NEGATIVE_VALUES_ERROR;
  int NaNValues = NAN_VALUES_ERROR;
  double ValidRange[2];
  int DensityResolution = 256;

  /**
   * What cells that hold no data count as: blanked cells, missing values, what data other than
   * images do not cover. Filters without these properties leave them Zero.
   */
  int EmptyCells = EMPTY_CELLS_ZERO;
  double EmptyValue = 0.0;

private:
  vtkAbstractArray* FindDensityArray(vtkDataSet* data, int arrayIndex, int& association);
  bool IsDensityOnPoints(vtkInformation* inputInformation, int arrayIndex);
  RectifiedTransport::Bridge::DensityChoice GetDensityChoice(int arrayIndex);

  const int DensityPort;
  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkDensityAlgorithm(const vtkDensityAlgorithm&) = delete;
  void operator=(const vtkDensityAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
