# SPDX-License-Identifier: BSD-3-Clause
"""The wrong changes that the tests have to notice.

Each names a file, a piece of text that stands there once, and what is wrong instead: an expression
(E), whole statements (S), or, with MUTANT for the condition that switches it on, any text that has
to compile both ways (T). X replaces text of the plugin's XML, which takes a build of its own. Where
«» stand in the text, only what is between them is replaced.
"""
from collections import namedtuple

Mutation = namedtuple("Mutation", "kind file right wrong")


def E(file, right, wrong):
    return Mutation("E", file, right, wrong)


def S(file, right, wrong):
    return Mutation("S", file, right, wrong)


def T(file, right, wrong):
    return Mutation("T", file, right, wrong)


def X(file, right, wrong):
    return Mutation("X", file, right, wrong)


CORE = "Filters/Core/"
BRIDGE = "Filters/Bridge/"

# These once passed all tests.
SURVIVED = [
    E(CORE + "Flow/Kernels/BoxMoments.txx", "linear[0] + linear[4]", "1.01 * (linear[0] + linear[4])"),
    E(CORE + "Flow/Kernels/FlowVelocity.txx", "truncated(smaller(larger(b, 0.0), size) + 0.5)",
      "smaller(larger(b, 0.0), size)"),
    E(BRIDGE + "Density/DensityReader.cxx", "static_cast<double>(begin(i, alpha)) / white",
      "static_cast<double>(begin(i, alpha)) / 255.0"),
    E(BRIDGE + "Splat/MassSplatter.cxx", "«given.Values()», 1.0, target",
      "(points->GetPoints()->GetDataType() == VTK_FLOAT ? nullptr : given.Values())"),
    E("Filters/vtkTransportSampler.cxx", "report.SeedsMoved > 0", "report.SeedsMoved > 1"),
    E("Filters/vtkTransportSampler.cxx", "report.ParticlesMoved > 0", "report.ParticlesMoved > 1"),
    E("Filters/vtkEqualMassCells.cxx", "report.Outside > 0", "report.Outside > 1"),
    E("Filters/vtkDensityEqualizingWarp.cxx", "if («outside > 0»)", "outside > 1"),
    E("Filters/vtkMassSplatter.cxx", "if («outside > 0»)", "outside > 1"),
    E(BRIDGE + "Density/DensityImage.cxx", "SetBlanks(this->CellFlags, «ghostCell»)",
      "ghostCell & ~vtkDataSetAttributes::REFINEDCELL"),
    E(BRIDGE + "Density/DensityImage.cxx", "time(this->Sources[0]), «time(this->Sources[1])»",
      "std::uint64_t{ 0 }"),
    E(CORE + "Quality/ParticleQuality.cxx", "static_cast<double>(this->Size[axis]) / this->Scale.ToUnits(aspect[axis])",
      "1.0"),
    E(CORE + "Mesh/SurfaceOrientation.cxx", "area += this->Orientations.data()[queue[next]] * «this->AreaOf(queue[next])»",
      "1.0"),
    S(BRIDGE + "Blend/DensityBlend.cxx", "array->Modified();", ";"),
    E(CORE + "Flow/PivotLattice.cxx", "«report.MovedToMass» +=", "report.MovedToMass = 0"),
    E(BRIDGE + "Image/CommonGrid.cxx", "planeTolerance * longest", "1e3 * planeTolerance * longest"),
    E(BRIDGE + "Image/CommonGrid.cxx", "cwiseAbs().array() <= «rounding»", "1e-3"),
    S(BRIDGE + "Points/PointMasses.cxx", "all.First = all.NotFinite == 0 ? range.First : all.First;",
      "all.First = range.First;"),
    E(CORE + "SiteCells/SplitSharedPixels.cxx", "const double spread = «this->Spacing[axis] * (high - low)»",
      "high - low"),
    E(CORE + "SiteCells/EqualizeSiteCells.cxx", "this->Weight[axis] = «side * side»", "1.0"),
    E(BRIDGE + "Image/ImageGrids.cxx", "std::lround(resolution * (lengths[i] / longest))",
      "std::lround(std::floor(resolution * (lengths[i] / longest)))"),
    E(BRIDGE + "Image/SolidGrid.cxx", "std::ceil(part * resolution - rounding)",
      "std::ceil(part * resolution)"),
    T(CORE + "Flow/Kernels/MultistepLanes.txx", "constexpr double rounding = 1e-9;\n    alignas(64) Lanes mass;",
      "const double rounding = MUTANT ? 1e-3 : 1e-9;\n    alignas(64) Lanes mass;"),
    S(CORE + "Flow/Kernels/FlowKernels.cxx", "c[0] = c[1] = 0.5;", "c[0] = 1.0; c[1] = 0.0;"),
    E(CORE + "Seeds/BlueNoise.cxx", "*last + 0.5 * (next - *last)", "*last + 0.999 * (next - *last)"),
]

# The same kinds of mistakes in other places: an operator, a bound, an index, a factor, a unit, a line
# left out, in every folder of Filters.
OTHERS = [
    # tables and flow
    E(CORE + "Flow/Kernels/AdamsWeights.txx",
      "predictor[1] = «(1.0 / 3.0 - second / 2.0) / (first * (first - second))»",
      "1.001 * (1.0 / 3.0 - second / 2.0) / (first * (first - second))"),
    E(CORE + "Flow/Kernels/FlowMultistep.txx", "c[2] * (*lanes.V[1])[axis][i] - «c[0] * half»", "half"),
    E(CORE + "Flow/Kernels/FlowMultistep.txx", "«x[axis][lane] < t * size»)", "false"),
    E(CORE + "Flow/Kernels/FlowUniformSteps.txx", "const double weight = «stage < 3 ? 2.0 : 1.0»", "1.5"),
    E(CORE + "Flow/Kernels/FlowAdaptive.txx", "smaller(lanes.History[i] + 1.0, «2.0»)", "1.0"),
    E(CORE + "Flow/Kernels/FlowAdaptive.txx", "«0.1 * larger(distance, -distance)»",
      "0.001 * larger(distance, -distance)"),
    E(CORE + "Flow/Kernels/FlowLanes.txx", "const double stop = «x1[axis][lane] - rest * length * v1[axis][lane]»",
      "x1[axis][lane] + rest * length * v1[axis][lane]"),
    E(CORE + "Flow/Kernels/BoxMoments.txx", "boxes.Moment[1][lane] = «sums.Linear[2] + sums.Quadratic[0]»",
      "sums.Linear[2]"),
    E(CORE + "Tables/NearestMass.cxx", "return tables.Occupied + «row * tables.WordsPerRow»",
      "row * ((tables.Cells[0] >> 6) + 1)"),
    S(CORE + "Splat/SplatTiles.cxx", "visit(row * this->Tiles[0] + i);",
      "if (i < high[0] || i == low[0]) { visit(row * this->Tiles[0] + i); }"),
    E(CORE + "Flow/PivotLattice.cxx", "placeInCell<Dimension>(«i», perCell)", "(i ^ 1) % perCell"),
    # seeds
    E(CORE + "Seeds/BlueNoise.cxx", "«coordinates[a] * 0x1p-16»", "coordinates[a] * 0x1.01p-16"),
    E(CORE + "Seeds/Seeds.cxx", "«std::max(n / ideal, ideal / n)»", "n / ideal"),
    # splats
    E(CORE + "Splat/Kernels/SplatBlock.txx", "mass[i] = «job.Scale * masses[first + begin + i]»",
      "masses[first + begin + i]"),
    E(CORE + "Splat/Kernels/SplatGaussian.txx", "for (; __builtin_fabs(x) > «0.5»", "4.0"),
    # cells, solids, quality
    E(CORE + "SiteCells/BorderMaxFlow.cxx", "this->Capacity(from.Border, «-from.Sign») > 0", "from.Sign"),
    E(CORE + "SiteCells/SiteDensity.cxx", "«*next < first + count»", "*next <= first + count - 2"),
    E(CORE + "Solid/SolidCoverage.cxx", "std::ceil(coordinate - «0.5»); // the", "0.25"),
    E(CORE + "Solid/ClosedMesh.cxx", "if («a != b && b != c && c != a»)", "true"),
    E(CORE + "Mesh/SurfaceEdges.cxx", "«endsOf(triangles, *begin).High == high»",
      "endsOf(triangles, *begin).High >= high"),
    E(CORE + "Tables/BoxShare.cxx", "«std::clamp(this->Centre[axis] + h * this->Aspect[axis], 0.0, size)»",
      "this->Centre[axis] + h * this->Aspect[axis]"),
    E(CORE + "Flow/MapDerivatives.cxx", "«below && above» ? 2.0 * this->Step[axis]", "below || above"),
    E(CORE + "Quality/NearestNeighbours.cxx", "const bool lowest = «!(pivot > box.Low[axis])»", "false"),
    E(CORE + "Flow/WeightedMean.cxx", "begin += «block»", "block + 1"),
    # maps of disks
    E(CORE + "Parameterization/SquareCorners.cxx", "return «length(a) > length(b)»", "length(a) < length(b)"),
    E(CORE + "Parameterization/SquareCorners.cxx",
      "«places.Steps(arc.From, next->first) + next->second > steps»", "true"),
    E(CORE + "Parameterization/IntrinsicDelaunay.cxx", "{ side / 3, «other / 3» }", "side / 3"),
    S(CORE + "Algebra/SparseCholesky.cxx", "  «Current = nullptr;»\n}", ";"),
    E(CORE + "Parameterization/ConformalMap.cxx", "dirichletEnergy(triangles, «values[1]»)", "values[0]"),
    E(CORE + "Parameterization/MassRaster.cxx", "polygon.Area() > «accuracy * cells * length»", "1e-14"),
    E(CORE + "Parameterization/MassRaster.cxx", "if («rows[0] < firstRow»)", "false"),
    E(CORE + "Parameterization/MapDistortion.cxx", "sum += «weight»", "1.0 / static_cast<double>(ascending.size())"),
    S(CORE + "Parameterization/MapTiles.cxx", "taken.insert(groupOf[neighbour]);", ";"),
    E(CORE + "Parameterization/LocalMap.cxx", "isFree && «(sides >> axis & 1) == 0»", "sides == 0"),
    E(CORE + "Parameterization/AreaPolish.cxx", "«right[m] -= this->Smoothing * value * (a[axis] - b[axis])»",
      "right[m] += this->Smoothing * value * (a[axis] - b[axis])"),
    E(CORE + "Parameterization/AreaPolish.cxx", "«this->Energy(this->Moved) < before»", "true"),
    S(CORE + "Parameterization/FlipRepair.cxx", "addRing(parts, isIn, points);", ";"),
    E(CORE + "Parameterization/AreaPreservingMap.cxx", "std::clamp(position, «inside», 1.0", "0.0"),
    E(CORE + "Parameterization/AreaPreservingMap.cxx", "map.Distortion.Area95 > «distant»", "1e9"),
    # particles on surfaces
    E(CORE + "SurfaceSampling/Turn.cxx", "«std::abs(turn) > bound * (std::abs(left) + std::abs(right))»",
      "true"),
    E(CORE + "SurfaceSampling/FlatLocator.cxx",
      "return last >= 0.0 && «(first > 0.0 || next > 0.0 || last > 0.0)»", "true"),
    E(CORE + "SurfaceSampling/FlatLocator.cxx", "best = «triangle < best && this->Contains(triangle, point)»",
      "this->Contains(triangle, point)"),
    E(CORE + "SurfaceSampling/FlatLocator.cxx", "if («gaps[child] <= best.Squared»)",
      "gaps[child] <= 0.5 * best.Squared"),
    E(CORE + "SurfaceSampling/SurfaceSamples.cxx", "samples.PatchError > «SurfaceSamples::AcceptableError»", "1e9"),
    E(CORE + "SurfaceSampling/SurfaceSamples.cxx", "options.Pattern, «lengthsOf(aspectRatio)»",
      "Point<2>({ 1.0, 1.0 })"),
    E(BRIDGE + "SurfaceSampling/SurfaceMasses.cxx", "if («ghosts && (ghosts[cell] & ghostCell)»)", "false"),
    E(BRIDGE + "SurfaceSampling/SurfaceSampler.cxx", "cell[i] = «surface.InputCellOf(place.Triangle)»",
      "surface.CellOf(place.Triangle)"),
    E(BRIDGE + "SurfaceSampling/SurfaceSampler.cxx", "found.Cell = «this->Surface.CellOf(on.Triangle)»",
      "static_cast<vtkIdType>(on.Triangle)"),
    # the bridge
    E(CORE + "Geometry/ImageGrid.cxx", "grid.SetAxis(i, this->PointExtent[2 * i] + «0.5»", "0.0"),
    E(BRIDGE + "SiteCells/DataStamp.h", "«this->Bits != 0 && this->Bits == previous.Bits»",
      "this->Bits == previous.Bits"),
    E(CORE + "SiteCells/SiteCellStatistics.cxx", "statistics.Cost[i] = sum.Cost / «pixels»", "sum.Weight"),
    S(BRIDGE + "Points/ParticleSet.cxx", "id[p] = i;", "id[p] = p;"),
    E(CORE + "Quality/ParticleQuality.cxx", "BlockCounts[axis] + «cell / this->BlockSize»",
      "(cell + 1) / (this->BlockSize + 1)"),
    S(CORE + "Quality/ParticleQuality.cxx", "difference += off * off / measure;",
      "difference += off * off;"),
    E(BRIDGE + "Blend/DensityBlend.cxx", "«this->Maps.front().TotalMass()» : 1.0",
      "this->Maps.back().TotalMass()"),
    E(BRIDGE + "Image/CommonGrid.cxx", "finest = «std::min(finest, std::abs(side.Spacing))»",
      "std::max(finest, std::abs(side.Spacing))"),
    E(CORE + "Flow/MapDisplacement.cxx", "const double weight = «this->Density ? this->Density->Share(low, high) : 1.0»",
      "1.0"),
    S(BRIDGE + "Surface/PolygonInput.cxx", "surface->SetStrips(strips);", ";"),
    E(CORE + "SiteCells/SiteCellOutlines.cxx", "if («below != none»)\n    {\n      this->Append(",
      "below != none && above != none"),
    # the tables that filters share
    E(BRIDGE + "Density/SharedFlow.cxx",
      "return «found == this->Entries.end()» ? nullptr : found->second.lock();", "true"),
    E(BRIDGE + "Density/SharedFlow.cxx", "flow.use_count() != 1", "false"),
    E(BRIDGE + "Density/DensityImage.cxx", "this->Hashed != Content{}", "false"),
    # the filters
    S("Filters/vtkTransportBarycenter.cxx",
      "this->Weights->List.resize(static_cast<std::size_t>(count));\n    this->Modified();",
      "this->Weights->List.resize(static_cast<std::size_t>(count));"),
    S(BRIDGE + "Flow/TransportMap.cxx",
      "output->GetCellData()->PassData(density.Image()->GetCellData());", ";"),
    E(BRIDGE + "Flow/DensityEqualizingWarp.cxx", "«blend * (this->Index[i * D + a] - move[a])»",
      "this->Index[i * D + a] - move[a]"),
    E(BRIDGE + "Splat/MassSplatter.cxx", "splatMassIn(density, target, progress)",
      "given.Total()"),
    E(BRIDGE + "Flow/TransportSampler.cxx", "count *= «sampler.SamplesPerCell»",
      "(sampler.SamplesPerCell > 2 ? 2 : sampler.SamplesPerCell)"),
    E("Filters/vtkUniformSeedSource.cxx", "«this->NumberOfPoints >= 1», \"NumberOfPoints\"",
      "this->NumberOfPoints != 0"),
    S("Filters/vtkGuardedAlgorithm.cxx", "image->GetPointData()->Initialize();", ";"),
    # disks and their parameterization
    E(CORE + "Mesh/DiskMesh.cxx", "if («reached != valence[static_cast<std::size_t>(point)]»)",
      "reached > valence[static_cast<std::size_t>(point)]"),
    E(CORE + "Mesh/DiskMesh.cxx", "this->TotalArea += «area»", "1.0"),
    E(BRIDGE + "Surface/DiskSurface.cxx", "before += «cells->GetNumberOfCells()»", "0"),
    E(BRIDGE + "Surface/DiskSurface.cxx", "id < this->FirstPolygon ? «id» :", "0"),
    S(BRIDGE + "Surface/DiskSurface.cxx", "stages.Next(0.45);\n  this->CopyCellData(input, progress);",
      ";"),
    E(BRIDGE + "Parameterization/AreaPreservingParameterization.cxx",
      "const vtkIdType offset = «this->Surface.CellOf(0)»", "0"),
    S(BRIDGE + "Parameterization/AreaPreservingParameterization.cxx",
      'data->SetActiveTCoords("AreaPreserving");',
      'data->SetTCoords(data->GetArray("AreaPreserving"));'),
    E(BRIDGE + "Parameterization/AreaPreservingParameterization.cxx",
      "«flipped > this->Collapsed» ||", "flipped > this->Collapsed + 1"),
    S(BRIDGE + "Settings/CornerSettings.cxx", "known = point;", ";"),
    # the plugin's XML: a domain, a range in the text, a decorator, a hint, an enumeration
    X("Plugin/TransportSampler.xml", 'name="FlowTime" command="SetFlowTime" number_of_elements="1"\n'
      '        default_values="1">\n        <DoubleRangeDomain name="range" min="0" max="«1»"/>', "2"),
    X("Plugin/TransportCommon.xml", "Range: 1 to «10000». Default: 32", "1000"),
    X("Plugin/TransportSampler.xml", 'property="SeedPattern" «values="1 2"»/>', 'values="1 3"'),
    X("Plugin/TransportSampler.xml", '<RepresentationType view="RenderView" type="«Point Gaussian»"/>',
      "Points"),
    X("Plugin/TransportCommon.xml", '<Entry value="«2»" text="Jittered"/>', "3"),
    # flow maps
    E(CORE + "Flow/Kernels/FlowMapLanes.txx", "static_cast<float>(«b * c * d * (-1.0 / 6.0)»)",
      "b * c * d * (-1.0 / 6.4)"),
    E(CORE + "Flow/Kernels/FlowMapLanes.txx", "fromEnd < nodes.Layer ? «nodes.Length - inLayer» : inside",
      "inside"),
    E(CORE + "Flow/Kernels/FlowMapLanes.txx", "«positions[axis][i] == positions[axis][i - 1]»", "true"),
    E(CORE + "Flow/Kernels/FlowMapNodes.txx", "first[i] = «last * lanes.Span[i]»", "last"),
    E(CORE + "Flow/Kernels/FlowMultistep.txx",
      "return «smaller(larger(seed[axis], 0.0), level.Axes[axis].Size)»", "seed[axis]"),
    E(CORE + "Flow/FlowMap.cxx", "(«isStraight» ? 0 : isBent(axis))", "true"),
    E(CORE + "Flow/FlowMap.cxx", "int relevant = «isTroubled»", "0"),
    E(CORE + "Flow/FlowMapShape.cxx", "return particles * share * saved > «this->Cost»", "0.0"),
    E(CORE + "Flow/PivotLattice.cxx", "positions.Part(place * each, each), «same», progress", "options"),
    E(CORE + "Flow/RectifiedFlow.cxx", "return «steps == this->Of» ?", "true"),
    E(CORE + "Flow/RectifiedFlow.cxx", "«firstTime < 1.0 - shape.Levels.back().TimeLeft»", "false"),
    # relaxation and power cells
    E(CORE + "Relaxation/RelaxationDescent.cxx", "const double rest = «isAimed» ? 0.0", "false"),
    E(CORE + "Relaxation/TransportRelaxation.cxx", "const double area = «frame.Sides[0] * frame.Sides[1]»",
      "count"),
    E(CORE + "Relaxation/TransportEnergy.cxx", "end = «density.NearestMass(end)»", "end"),
    E(CORE + "PowerCells/EqualMassPartition.cxx", "const std::size_t few = «weights.size() / 10»", "0"),
    E(CORE + "PowerCells/EqualMassPartition.cxx", "(«mass > 1.0» ? high : low) = found", "false"),
    E(CORE + "PowerCells/PowerDiagram.cxx", "doubtful.empty() && «corners != 4»", "false"),
    E(CORE + "PowerCells/PowerDiagram.cxx",
      "«other.Before(same).Neighbour == cell.After(k).Neighbour»", "true"),
    S(CORE + "PowerCells/PowerDiagram.cxx", "this->Doubt(j);", ""),
    E(CORE + "PowerCells/SeparateSites.cxx",
      "x[a] = «std::clamp(place, this->Bounds.Low[a], this->Bounds.High[a])»", "place"),
    E(CORE + "SiteCells/LabelPolygons.cxx", "const std::int64_t end = «columns.Begin < columns.End» ?",
      "columns.Begin + 1 < columns.End"),
    S(CORE + "Algebra/GraphLaplacian.cxx", "this->Edges.clear();", ""),
    E(CORE + "PowerCells/RowMoments.h", "«this->Second + this->First» + this->Mass / 3.0", "this->Second"),
    E(CORE + "Algebra/GraphLaplacian.cxx", "const double added = «damping * trace»", "damping"),
    E(CORE + "Seeds/WindowBorder.cxx", "«relaxation» * centroid[0]", "1.9"),
    # densities on data that are no images, and their values on particles
    E(CORE + "Overlap/Overlap.cxx", "measure * «(1.0 - part)»", "part"),
    E(CORE + "Overlap/Overlap.cxx", "(«0.5 * (low + high)» - box.Low[a])", "low"),
    E(CORE + "Overlap/OverlapLines.cxx", "(constant + «0.5 * slope * (from + to)»)", "slope * from"),
    E(CORE + "Overlap/OverlapLines.cxx", "face[1] == 0.0 && «at > 0.0»", "false"),
    E(BRIDGE + "Resampling/MeshDensity.cxx",
      "alongLines = «std::abs(found - size.Integral) <= tolerance * size.Integral»", "true"),
    E(BRIDGE + "Resampling/BlockValues.cxx", "(cellFlags[cell] & «ghostCell»)", "0"),
    E(BRIDGE + "Resampling/BlockValues.cxx",
      "(pointFlags[points->GetId(i)] & «vtkDataSetAttributes::HIDDENPOINT»)", "0"),
    E(BRIDGE + "Resampling/TiledImages.cxx", "if («!(a == b)» &&", "false"),
    E(BRIDGE + "Resampling/TiledImages.cxx", "«std::abs(along - steps) > rounding» ||", "false"),
    E(BRIDGE + "Resampling/TiledImages.cxx", "owner < 0 ? «hidden» :",
      "static_cast<unsigned char>(0)"),
    E(BRIDGE + "Resampling/ResampledDensity.cxx", "number(«block.Array->GetMTime()»)",
      "vtkMTimeType{ 0 }"),
    E(BRIDGE + "Resampling/PlacesInMeshes.cxx", "if («distance < best.Distance»)",
      "best.Distance > 1e300"),
    E(BRIDGE + "Points/SampledArrays.cxx",
      "tuple.fill(«hasNaN ? std::numeric_limits<Value>::quiet_NaN() : Value(0)»)", "Value(0)"),
    E(BRIDGE + "Points/SampledArrays.cxx", "if («isTaken» || isGhost", "false"),
    S(BRIDGE + "Points/SampledArrays.cxx",
      "vtkMath::RoundDoubleToIntegralIfNecessary(sum, &value);", "value = static_cast<Value>(sum);"),
    S(BRIDGE + "Run/SeparateInputs.cxx", "release(connection.Producer, connection.OutputPort);", ""),
    # cells of the mass of a density
    E(CORE + "SiteCells/PixelMasses.cxx",
      "std::min((cell + 1) * this->Pixels, «(pixel + 1) * this->Cells»)", "(cell + 1) * this->Pixels"),
    E(CORE + "SiteCells/EqualizeSiteMasses.cxx", "|| «mass >= this->Mass[from]»", "false"),
    E(CORE + "SiteCells/DensitySiteCells.cxx", "if («mass[group] == 0»)", "false"),
    E(CORE + "SiteCells/SiteColors.cxx", "neighbours.Join(first[i], «next[i]»)", "first[i]"),
]
