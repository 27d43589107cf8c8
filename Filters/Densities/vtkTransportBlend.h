// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportBlend
 * @brief   superclass of the filters that interpolate several densities
 *
 * Follows Sections 3.4, 5.2 and 5.3 of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport
 * with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. Particles
 * that are uniform in the unit box, the pivot, are moved to each density independently. Between the
 * densities each particle is at the weighted mean of these positions, in physical space. The mass
 * of the particles is spread on an image (see vtkMassSplatter).
 *
 * The inputs are densities (see vtkDensityAlgorithm) of any sizes, spacings and boxes, but with
 * axes of more than one point along the same directions. The outputs are
 * - port 0: vtkImageData with the density (active scalars; mass per length, area or volume; see
 *   ResultArrayName), point or cell data as in the first input, and field data;
 * - port 1: vtkPolyData with one vertex a particle, `Mass` (equal shares) and field data.
 *
 * The field data are `TotalMass` and `MovedParticles`: how many particles ended in an empty cell of
 * a density, counted for each input, and were put on the nearest mass. When maps are made, a
 * warning counts theirs if they are at least one in a thousand of the particles.
 *
 * The grid of the output does not depend on the weights. If the inputs have the same geometry, up
 * to the rounding of single precision, the grid is exactly that of the first input. Else, unless
 * Dimensions are set, it covers the smallest box that holds all domains, at the finest spacing
 * along each axis, or the least multiple of it that makes no more cells than the input with most of
 * them has. Numbers of cells are rounded up, and the box grows at its upper end.
 *
 * At a weight of 1 the density is that of the input as it is read, times the factor of MassMode: to
 * the bit, if that is 1 and the input is on the grid of the output, else by exact overlap. Within
 * 0.1 of that weight the cells of the input move with the particles, with a share that falls
 * linearly to 0.
 *
 * Cost: O(cells) for the tables and O(particles * steps) for the map of each input, once. The maps
 * are kept until a density, the integration, ParticlesPerCell or the grid changes. A change of the
 * weights costs O(particles + cells), a few times as much near a weight of 1. Memory: 24 bytes a
 * particle for each input and 48 for the output, 8 bytes a cell, and while a map is made the tables
 * of one density (see Tables). Particles and cells are distributed over the ranks.
 *
 * Images may be distributed over MPI ranks. Each rank gets the extent of the output image that it
 * requests and the particles at the positions that it owns. On one rank the outputs are in one
 * piece: if several are requested, piece 0 holds all data. Data other than images are gathered on
 * every rank.
 *
 * @warning The pivot makes this a linearized transport. The results resemble the displacement
 * interpolation and the barycenters of optimal transport but are not optimal.
 *
 * @sa vtkTransportInterpolator vtkTransportBarycenter vtkTransportAlgorithm
 */
#ifndef vtkTransportBlend_h
#define vtkTransportBlend_h

#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportAlgorithm.h"

#include <string> // for the array's name
#include <vector> // for the inputs

namespace RectifiedTransport
{
namespace Bridge
{
struct BlendInput;
struct BlendSettings;
class DensityBlend;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportBlend : public vtkTransportAlgorithm
{
public:
  vtkTypeMacro(vtkTransportBlend, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What MassMode may be.
   */
  enum MassModeType
  {
    MASS_LINEAR = 0,
    MASS_GEOMETRIC = 1,
    MASS_SOURCE = 2,
    MASS_NORMALIZE = 3
  };

  ///@{
  /**
   * The number of values of the output along the image's x, y and z, on the smallest box that holds
   * all domains; 0: by the rule above. At least 0 each; along an axis of one point 0 or 1; for
   * point data 0 or at least 2 along the others. Default 0 0 0.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * The number of particles in each cell of the output's grid, scaled to the unit box: at least 1,
   * or 0 (default) for Auto, which is 4. If it is 4, 9 ... in 2D or 8, 27 ... in 3D, the particles
   * are the centres of a finer grid, else a fixed low-discrepancy set. With one, and CloudInCell,
   * even parts of the output have stripes, and solids spikes. Time and memory grow with it.
   */
  vtkSetMacro(ParticlesPerCell, int);
  vtkGetMacro(ParticlesPerCell, int);
  ///@}

  ///@{
  /**
   * The total mass of the output, from the masses M_i and the weights w_i of the inputs. Linear
   * (default): the sum of w_i M_i. Geometric: the product of M_i^w_i. Source: M_0. Normalize: 1.
   */
  vtkSetMacro(MassMode, int);
  vtkGetMacro(MassMode, int);
  void SetMassModeToLinear() { this->SetMassMode(MASS_LINEAR); }
  void SetMassModeToGeometric() { this->SetMassMode(MASS_GEOMETRIC); }
  void SetMassModeToSource() { this->SetMassMode(MASS_SOURCE); }
  void SetMassModeToNormalize() { this->SetMassMode(MASS_NORMALIZE); }
  const char* GetMassModeAsString();
  ///@}

  ///@{
  /**
   * The name of the output's density. Empty (default) or nullptr: the name of the inputs' arrays,
   * or `Density` where these differ.
   */
  void SetResultArrayName(const char* name);
  const char* GetResultArrayName();
  ///@}

  ///@{
  /**
   * How the mass of a particle is spread over the image's cells (or dual cells) around it.
   * CloudInCell: linearly over 2 cells along each axis. NearestCell: into the cell that contains
   * the point (on a face, the upper cell). TriangularShapedCloud (default): quadratically over 3
   * cells. Gaussian: as a Gaussian of the given Radius.
   */
  vtkSetMacro(Kernel, int);
  vtkGetMacro(Kernel, int);
  void SetKernelToCloudInCell() { this->SetKernel(CLOUD_IN_CELL); }
  void SetKernelToNearestCell() { this->SetKernel(NEAREST_CELL); }
  void SetKernelToTriangularShapedCloud() { this->SetKernel(TRIANGULAR_SHAPED_CLOUD); }
  void SetKernelToGaussian() { this->SetKernel(GAUSSIAN); }
  const char* GetKernelAsString();
  ///@}

  ///@{
  /**
   * The standard deviation of the Gaussian, in cells, above 0 and at most 10000. Default 1. The
   * kernel is cut at 3 standard deviations and corrected to first order so that it keeps the
   * centroid. Up to a third of a cell it is CloudInCell.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  /**
   * The interpolated density, output port 0.
   */
  vtkImageData* GetDensity() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }

  /**
   * The particles, output port 1.
   */
  vtkPolyData* GetParticles() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }

protected:
  /**
   * Whether each block of a composite input is an input of its own; else all of them are one
   * density.
   */
  explicit vtkTransportBlend(bool blocksAreInputs);
  ~vtkTransportBlend() override;

  /**
   * Blend the inputs. `names` are used in messages and, with "Position" appended, for arrays of the
   * particles; if nullptr, messages number the inputs. `weights` are one for each input; without
   * any, all inputs weigh the same. They are divided by their sum. Throws what RequestData may
   * throw.
   */
  void BlendInputs(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    const RectifiedTransport::Bridge::BlendSettings& settings, const char* const* names,
    const std::vector<double>& weights);

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * The properties, checked. Throws what RequestData may throw.
   */
  RectifiedTransport::Bridge::BlendSettings GetBlendSettings();

  int Dimensions[3] = { 0, 0, 0 };
  int ParticlesPerCell = 0;
  int MassMode = MASS_LINEAR;
  std::string ResultArrayName;
  int Kernel = TRIANGULAR_SHAPED_CLOUD;
  double Radius = 1.0;

private:
  std::vector<RectifiedTransport::Bridge::BlendInput> ReadInputs(vtkInformationVector** inputVector,
    const char* const* names, RectifiedTransport::Progress& progress);

  const bool BlocksAreInputs;
  std::unique_ptr<RectifiedTransport::Bridge::DensityBlend> Blend;

  vtkTransportBlend(const vtkTransportBlend&) = delete;
  void operator=(const vtkTransportBlend&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
