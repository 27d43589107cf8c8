// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportQuality
 * @brief   how well particles follow a density, in one row of numbers
 *
 * Input 0 is the particles, any vtkPointSet. Input 1 is the density, a data set (see
 * vtkDensityAlgorithm), chosen with SetInputArrayToProcess(0, 1, 0, ...). The point array `Mass`
 * weights the particles; without it they weigh the same. Weights are divided by their sum. Points
 * that the ghost array marks as duplicate or hidden count neither as particles nor as neighbours.
 *
 * The output is a vtkTable of one row with the columns
 * - `Particles`, their number, and `TotalMass`, the density times cell measure, summed;
 * - `Outside`, the number of particles outside the domain by more than a millionth of its diagonal
 *   (with a density of one or two dimensions, also those off its line or plane);
 * - `InEmptyCells`, the number of other particles in cells of the density without mass (on a face:
 *   if all cells at it are without mass);
 * - `DensityError`, the relative L2 distance between the particles' density and the given one, both
 *   averaged over blocks of BlockSize cells: sqrt(sum (p - m)^2 / v) / sqrt(sum m^2 / v), where p
 *   and m are a block's shares of the particles' mass and of the density's, and v is its measure.
 *   Particles outside count in the total mass, but in no block;
 * - `LargestBlockError`, the largest |p - m| / m of these blocks, of those in which the mean of the
 *   density is more than 5 % of that of the domain;
 * - `TransportCost`, the mean of |Displacement|^2, by weight, in squared physical units, from the
 *   point array `Displacement`; 0 without it;
 * - `SmallestSpacing` and `MeanSpacing`, over the particles in the domain that have mass: the
 *   distance to the nearest other particle, relative to the largest possible one for the local
 *   density. That is the distance in a regular row (1D), the hexagonal (2D) or face-centred cubic
 *   lattice (3D) in which each point takes the measure V: V, sqrt(2 V / sqrt(3)), cbrt(sqrt(2) V)
 *   (twice the r_max of Lagae and Dutre, "A Comparison of Methods for Generating Poisson Disk
 *   Distributions", Computer Graphics Forum 27(1), 2008). V is the measure of the smallest cube
 *   about the particle, clipped to the domain, in which the density has the particle's share of the
 *   mass. Perfect lattices have 1, blue noise less, clumps near 0. Both are 0 if no particle in the
 *   domain has a neighbour.
 *
 * An input without points or with only ghosts gives a table without rows; so does every piece
 * except piece 0. If MPI ranks request one piece each, they run the filter together. Each rank
 * gives its part of the particles and of the density. Rank 0 has the row of all, bitwise as on one
 * rank. Sums are in the order of the integer point array `SeedId`, or else of the global ids, if
 * all ranks have them; else in the order of the ranks. If all ranks have the same particles, they
 * are one data set. With Tables Tiled, no rank holds the whole density or its tables.
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(n log n) for n
 * particles. Tables Tiled supports 2D and 3D densities and any particles; the tables of tiles are
 * made in each run. The V of a particle is then interpolated if its cube is wider than the rim of a
 * tile (11.5 strides of the tables of few nodes), else it differs by rounding. Memory: about 100
 * bytes a particle and 16 a block while it runs, plus the tables (see vtkTransportAlgorithm). With
 * ghosts or values that are not double, copies of the points, of Mass and of Displacement take 24,
 * 8 and 24 more. The numbers are bitwise the same for every number of threads.
 *
 * @warning With few particles a block, DensityError measures their noise: about 1 / sqrt(particles
 * a block) for independent particles. LargestBlockError does so in blocks where the density is
 * thin; set a larger BlockSize for it.
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
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTable.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportQuality : public vtkDensityAlgorithm
{
public:
  static vtkTransportQuality* New();
  vtkTypeMacro(vtkTransportQuality, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of cells of the density along each axis in a block of DensityError. The last block
   * of an axis may have fewer. Default 0: the smallest number with which blocks hold 64 particles
   * on average over the domain. DensityError is then about 1/8 for independent particles, and less
   * for particles that are spread more evenly.
   */
  vtkSetMacro(BlockSize, int);
  vtkGetMacro(BlockSize, int);
  ///@}

  ///@{
  /**
   * Which tables the measurement uses. Whole: summed-area tables of the whole grid, 32 bytes a
   * cell, which are kept until the density changes. Tiled: tables of few nodes and, one after
   * another, tables of tiles, made in each run. Tiled takes an eighth of the memory at 512^3 cells
   * in about the same time. It is as exact but not bitwise equal. Auto (default): Tiled for
   * densities of more than 2^26 cells in 2D and 3D, else Whole.
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
  void SetDensityConnection(vtkAlgorithmOutput* density) { this->SetInputConnection(1, density); }

  /**
   * The same, as a data object.
   */
  void SetDensityData(vtkDataObject* density) { this->SetInputData(1, density); }

  /**
   * The table of one row.
   */
  vtkTable* GetOutput() { return vtkTable::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkTransportQuality();
  ~vtkTransportQuality() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int BlockSize = 0;
  int Tables = TABLES_AUTO;

private:
  vtkTransportQuality(const vtkTransportQuality&) = delete;
  void operator=(const vtkTransportQuality&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
