// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportQuality
 * @brief   how well particles follow a density, in one row of numbers
 *
 * Input 0 is the particles, any vtkPointSet, input 1 the density, a data set (see
 * vtkDensityAlgorithm), chosen with SetInputArrayToProcess(0, 1, 0, ...). Particles weigh by their
 * point array `Mass` if they have it, else equally; weights count as shares of their sum. Points
 * that the ghost array marks as duplicate or hidden count neither as particles nor as neighbours.
 *
 * The output is a vtkTable of one row with the columns
 * - `Particles`, their number, and `TotalMass`, the density times cell measure, summed;
 * - `Outside`, the number of particles outside of the domain (off the plane or line of a density of
 *   fewer than three dimensions, too), by more than a millionth of its diagonal;
 * - `InEmptyCells`, the number of the others that are in cells of the density without mass (on a
 *   face: where all cells at it are);
 * - `DensityError`, the relative L2 distance between the particles' density and the given one, both
 *   averaged over blocks of BlockSize cells: with p and m a block's shares of the particles' mass
 *   and of the density's, and v its measure, sqrt(sum (p - m)^2 / v) / sqrt(sum m^2 / v). Particles
 *   outside count in the total mass, but in no block;
 * - `TransportCost`, the mean of |Displacement|^2, by weight, in squared physical units, from the
 *   point array `Displacement`; 0 without it;
 * - `SmallestSpacing` and `MeanSpacing`, over the particles in the domain that have mass: the
 *   distance from the nearest other particle, relative to the largest possible one for the local
 *   density. That is the distance in a regular row (1D), the hexagonal (2D) or face-centred cubic
 *   lattice (3D) in which each point takes the measure V: V, sqrt(2 V / sqrt(3)), cbrt(sqrt(2) V)
 *   (twice the r_max of Lagae and Dutre, "A Comparison of Methods for Generating Poisson Disk
 *   Distributions", Computer Graphics Forum 27(1), 2008). V is the measure of the smallest cube
 *   about the particle, clipped to the domain, in which the density has the particle's share of the
 *   mass. Perfect lattices have 1, blue noise less, clumps near 0. Both are 0 where no particle in
 *   the domain has a neighbour.
 *
 * An input without points, or of ghosts only, gives a table without rows, and so does every piece
 * but piece 0. Where ranks of MPI request a piece each, they run the filter together: each gives
 * its part of particles and density, and the first one has the row of all, with the bits of one
 * rank; sums are in the order of the point array `SeedId` of integers, or else of the global ids,
 * where all ranks have them, else of the ranks. Particles that are the same on all ranks are one
 * data set. With Tables Tiled no rank has the density or the tables of all.
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(n log n) for n
 * particles. Tables Tiled takes 2D and 3D densities and any particles; those of tiles are made in
 * each run. The V of a particle is then interpolated where its cube is wider than the rim of a tile
 * (11.5 strides of the tables of few nodes), else it differs by rounding. Memory: about 100 bytes a
 * particle and 16 a block while it runs, beside the tables (see vtkTransportAlgorithm). Where there
 * are ghosts or values that are not double, copies of the points, of Mass and of Displacement take
 * 24, 8 and 24 more. The numbers are the same to the last bit for every number of threads.
 *
 * @warning With fewer than several particles a block, DensityError measures their noise: about
 * 1 / sqrt(particles a block) for independent ones.
 *
 * \code{.cpp}
 * vtkNew<vtkTransportQuality> quality;
 * quality->SetInputConnection(sampler->GetOutputPort());
 * quality->SetDensityData(image);
 * quality->Update();
 * double error = quality->GetOutput()->GetValueByName(0, "DensityError").ToDouble();
 * \endcode
 *
 * @sa vtkTransportSampler vtkDensityAlgorithm
 */
#ifndef vtkTransportQuality_h
#define vtkTransportQuality_h

#include "vtkDensityAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkTable;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkTransportQuality : public vtkDensityAlgorithm
{
public:
  static vtkTransportQuality* New();
  vtkTypeMacro(vtkTransportQuality, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Tables may be.
   */
  enum TablesType
  {
    TABLES_AUTO = 0,
    TABLES_WHOLE = 1,
    TABLES_TILED = 2
  };

  ///@{
  /**
   * The number of cells of the density along each axis in a block of DensityError, at least 1; the
   * last block of an axis may have fewer. Default 0: the least number with which blocks have 64
   * particles on average over the domain. DensityError is then about 1/8 for independent particles,
   * and less for those that are spread more evenly.
   */
  vtkSetMacro(BlockSize, int);
  vtkGetMacro(BlockSize, int);
  ///@}

  ///@{
  /**
   * What the measurement keeps of a density. Whole: summed-area tables of the whole grid, 32 bytes
   * a cell, until the density changes. Tiled: tables of few nodes, and those of tiles, which are
   * made in each run and worked through one after another: an eighth of the memory at 512^3 cells,
   * in about the same time, as exact but of other bits. Auto (default): Tiled for densities of more
   * than 2^26 cells where it serves, else Whole.
   */
  vtkSetMacro(Tables, int);
  vtkGetMacro(Tables, int);
  void SetTablesToAuto() { this->SetTables(TABLES_AUTO); }
  void SetTablesToWhole() { this->SetTables(TABLES_WHOLE); }
  void SetTablesToTiled() { this->SetTables(TABLES_TILED); }
  const char* GetTablesAsString();
  ///@}

  /**
   * Set the density (input 1), as the output of another filter.
   */
  void SetDensityConnection(vtkAlgorithmOutput* density);

  /**
   * The same, as a data object.
   */
  void SetDensityData(vtkDataObject* density);

  /**
   * The table of one row.
   */
  vtkTable* GetOutput();

protected:
  vtkTransportQuality();
  ~vtkTransportQuality() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int BlockSize;
  int Tables;

private:
  vtkTransportQuality(const vtkTransportQuality&) = delete;
  void operator=(const vtkTransportQuality&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
