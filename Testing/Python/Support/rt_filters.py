# SPDX-License-Identifier: BSD-3-Clause
"""The register of filters and properties: each is here once, with what tests cannot read from the XML or
the classes. A test that concerns every filter, or every one of a kind, goes through these tables, so that
a new filter or property is tested by a new entry.

Imports nothing but the standard library: scripts on ranks and in bare systems use it, too.
"""
from typing import NamedTuple

POINTS = {"view": "RenderView", "type": "Point Gaussian"}
DOTS = {"type": "Dots"}
READING = ("ReadAsParticles", {})
PARTICLES = [("RepresentationType", POINTS), ("FirstDisplay", DOTS)]
VOLUME = ("FirstDisplay", {"dimension": "3", "type": "Volume", "array": "Density"})
BLEND = [("View", {"type": "None", "port": "1"}),
         *((tag, {**hint, "port": "1"}) for tag, hint in PARTICLES),
         ("FirstDisplay", {"port": "0", "dimension": "3", "type": "Volume"})]
HALF_MORPH, HALF_MEAN = (
    ("FirstContour", {"port": "0", "half_of": inputs})
    for inputs in ("Input DensityArray Target TargetArray", "Input DensityArray"))
SMOOTH = {"Kernel": "TriangularShapedCloud"}
# Properties as they stand on panels, from top to bottom.
RULES = ["Component", "InvertDensity", "NegativeValues", "NaNValues", "ValidRange", "DensityResolution"]
DENSITY_PANEL = ["DensityArray", *RULES]
FLOW_PANEL = ["Integrator", "NumberOfSteps", "AreaTolerance", "Tolerance", "TableLookup", "FlowMaps"]
METHOD_PANEL = ["Method", "OptimalityTolerance", "Certify"]
TILED_PANEL = [*METHOD_PANEL, *FLOW_PANEL, "Tables", "Device", "DeviceName", "Threading"]
BLEND_PANEL = ["ParticlesPerCell", "MassMode", "Dimensions", "ResultArrayName", "Kernel", "Radius",
               *TILED_PANEL]


class Filter(NamedTuple):
    """A filter or source. No version changes the label, the class or the names of inputs and outputs.

    Kinds of inputs: density (any data with one), densities (several of these), image (its geometry),
    points (no cells are read), mesh (points whose cells are passed on), disk and solid (surfaces), map (regions with masses
    on their cells).
    """
    label: str
    class_name: str
    inputs: dict = {}      # the kinds of what is needed, by name; by port
    optional: dict = {}    # and of what may stay empty, on the ports after these
    outputs: list = []     # their names, if there are several
    panel: list = []       # the properties from top to bottom: of the filter, the density, the output, the flow
    refused: tuple = ()    # a property, a value that is out of range, one in range
    quick: dict = {}       # properties for a run of milliseconds
    variants: dict = {}    # further ones, of outputs of another kind, by name
    saved: dict = {}       # values that are no defaults and have to come back from a state
    shown: list = []       # hints of how an output is shown at first, where it is not as ParaView shows all
    always_shown: tuple = ()     # properties that mean something else here than PROPERTIES has them mean
    defaults: dict = {}          # choices that are not the first one here
    choices: dict = {}           # those of properties that mean something else here
    slow_at_highest: tuple = ()  # properties that take 10 GB at their highest value
    shown_at: dict = {}          # by value of Method: the properties that no other value shows
    of_disks: dict = {}          # properties with which it takes no surfaces but disks
    one_box: bool = False        # whether its densities must fill the same box
    gives_table: bool = False
    gives_figures: bool = True   # whether its outputs have field data of its own
    on_ranks: bool = True  # whether ParaView offers it on servers of several processes

    @property
    def name(self):
        """In Python."""
        return self.label.replace(" ", "")

    @property
    def ports(self):
        """The names and kinds of all inputs."""
        return {**self.inputs, **self.optional}

    def port_of(self, *kinds):
        """The first port of an input of some kinds; None if it has none."""
        return next((port for port, kind in enumerate(self.ports.values()) if kind in kinds), None)

    def make(self, simple, sources, optional=False, **properties):
        """Its proxy for a quick run. sources gives a source for each kind of input; from a name before
        the kind, if both are in it."""
        given = {name: sources.get(name) or sources[kind]
                 for name, kind in (self.ports if optional else self.inputs).items()}
        return getattr(simple, self.name)(**{name: make() for name, make in given.items()},
                                          **{**self.quick, **properties})


FILTERS = [
    Filter("Sample Density", "vtkTransportSampler",
           {"Input": "density"}, {"Seeds": "points"},
           panel=["Seeds", "NumberOfParticles", "SeedPattern", "RandomSeed", "SamplesPerCell", "FlowTime",
                  *DENSITY_PANEL, "OutputPaths", "SampleArrays", *TILED_PANEL],
           refused=("NumberOfSteps", -1, 2), quick=dict(NumberOfParticles=50),
           variants={"paths": dict(NumberOfParticles=5, OutputPaths=1, NumberOfSteps=4)},
           saved=dict(InvertDensity=1, FlowTime=0.75, Integrator="RungeKutta4", NumberOfSteps=12,
                      NaNValues="Empty", ValidRange=[0, 200]),
           shown=[PARTICLES[0],
                  ("FirstDisplay", {"property": "OutputPaths", "value": "1", "type": "Wireframe",
                                    "array": "Time"}),
                  ("FirstDisplay", {"property": "OutputPaths", "value": "0", **DOTS})]),
    Filter("Transport Map", "vtkTransportMap", {"Input": "density"}, {"Target": "density"},
           panel=["Target", "Direction", "EqualizeAreas", "DensityArray", "TargetArray", *RULES, "EmptyCells",
                  "EmptyValue", "SampleDimensions", *TILED_PANEL],
           refused=("NumberOfSteps", -1, 2),
           saved=dict(InvertDensity=1, Direction="DensityToUniform", EqualizeAreas=1, EmptyCells="Minimum",
                      SampleDimensions=[20, 30, 1], Integrator="Adaptive", Tolerance=0.5, Certify=1),
           shown=[("FirstDisplay", {"dimension": "3", "property": "Target", "value": "1",
                                    "type": "Surface", "array": "CostDensity"}),
                  ("FirstDisplay", {"property": "Target", "value": "1", "array": "CostDensity"}),
                  ("FirstDisplay", {"dimension": "3", "type": "Surface", "array": "Displacement"}),
                  ("FirstDisplay", {"array": "Displacement"})]),
    Filter("Equal Mass Cells", "vtkEqualMassCells",
           {"Input": "mesh"}, {"Domain": "density"}, ["Labels", "Sites", "Outlines", "Polygons"],
           panel=["Domain", "Measure", "Resolution", "Shape", "NormExponent", "CostExponent",
                  *DENSITY_PANEL, *FLOW_PANEL, "Threading"],
           refused=("NormExponent", 0, 2), quick=dict(Resolution=16),
           # ParaView looks for an array's components on Input, and complains of one that has no data yet.
           always_shown=("Component",),
           saved=dict(Resolution=60, CostExponent=4, NumberOfSteps=20),
           shown=[("RepresentationType", {"view": "RenderView", "type": "Surface", "port": "0"}),
                  ("View", {"type": "None", "port": "1"}),
                  ("View", {"type": "None", "port": "3"}),
                  ("FirstDisplay", {"port": "0", "array": "SiteColor", "categories": "1"}),
                  ("FirstDisplay", {"port": "3", "type": "Filled Outlines With Edges", "array": "SiteColor",
                                    "categories": "1"}),
                  ("FirstDisplay", {"port": "2", "dimension": "3", "type": "Feature Edges", "array": ""}),
                  ("FirstDisplay", {"port": "2", "array": ""})]),
    Filter("Morph Densities", "vtkTransportInterpolator",
           {"Input": "density", "Target": "density"}, outputs=["Density", "Particles"],
           panel=["Target", "Parameter", "PublishTime", "NumberOfTimeSteps", "DensityArray", "TargetArray", *RULES,
                  *BLEND_PANEL],
           refused=("Parameter", 2, 0.5),
           saved=dict(Parameter=0.25, MassMode="Geometric", Kernel="Gaussian", Radius=2,
                      ParticlesPerCell=2, Dimensions=[30, 0, 0], ResultArrayName="rho", PublishTime=1,
                      NumberOfTimeSteps=7),
           shown=[*BLEND, HALF_MORPH], defaults=SMOOTH),
    Filter("Density Barycenter", "vtkTransportBarycenter",
           {"Input": "densities"}, outputs=["Density", "Particles"],
           panel=["Weights", *DENSITY_PANEL, *BLEND_PANEL],
           refused=("ParticlesPerCell", -1, 1),
           saved=dict(Weights=[1, 0.5, 2], MassMode="Normalize", InvertDensity=1, ResultArrayName="rho"),
           shown=[*BLEND, HALF_MEAN], defaults=SMOOTH),
    Filter("Transport Distance", "vtkTransportDistance",
           {"Input": "densities"}, outputs=["Distances", "Bounds", "Coordinates"],
           panel=["Method", "OverTime", "MassDifference", "NumberOfCoordinates", "InputNames", *DENSITY_PANEL,
                  "Threading"],
           refused=("NumberOfCoordinates", 0, 3),
           saved=dict(Method="Certified", NumberOfCoordinates=3, InvertDensity=1),
           choices={"Method": ["Linearized", "Certified"]}, one_box=True,
           shown=[("View", {"type": "None", "port": "0"}), ("View", {"type": "None", "port": "1"}),
                  ("View", {"type": "XYPointChartView", "port": "2"}),
                  ("PipelineIcon", {"name": "XYChartView", "port": "2"}),
                  ("FirstDisplay", {"port": "2", "type": "Scatter", "x": "Coordinate0", "y": "Coordinate1"})], gives_table=True),
    Filter("Transport Temporal Interpolator", "vtkTransportTemporalInterpolator",
           {"Input": "density"}, outputs=["Density", "Particles"],
           panel=["Method", "ResampleFactor", "TrackParticles", "AdvectArrays", *DENSITY_PANEL, "ParticlesPerCell",
                  "Kernel", "Radius", "Threading"],
           refused=("ParticlesPerCell", 0, 1),
           saved=dict(Method="RectifiedFlow", ResampleFactor=3, TrackParticles=1, AdvectArrays=0, ParticlesPerCell=2,
                      Kernel="Gaussian", Radius=2, InvertDensity=1),
           defaults={"Method": "Optimal"},
           shown=[("View", {"type": "None", "port": "1"}),
                  *((tag, {**hint, "port": "1"}) for tag, hint in PARTICLES),
                  ("FirstDisplay", {"port": "0", "dimension": "3", "type": "Volume"})]),
    Filter("Splat Mass", "vtkMassSplatter",
           {"Input": "points"}, {"Reference": "image"},
           panel=["Reference", "MassArray", "Kernel", "Radius", "Boundary", "Dimensions", "Association",
                  "DivideByVolume", "Threading"],
           refused=("Radius", 0, 1), quick=dict(Dimensions=[8, 7, 6]),
           saved=dict(Dimensions=[30, 20, 1], MassArray=["POINTS", "Mass"], Kernel="Gaussian", Radius=1.5,
                      Boundary="Drop", Association="Cells"),
           shown=[VOLUME]),
    Filter("Solid Density", "vtkSolidDensity", {"Input": "solid"},
           panel=["Resolution", "Supersampling", "Padding", "Association", "OpenSurfaces", "Threading"],
           refused=("Supersampling", 99, 2), quick=dict(Resolution=12),
           saved=dict(Resolution=20, Supersampling=3, Padding=0.25, Association="Cells",
                      OpenSurfaces="WindingNumber", Threading="Serial"),
           shown=[VOLUME, ("FirstContour", {"array": "Density", "value": "0.5"})], gives_figures=False),
    Filter("Area Preserving Parameterization", "vtkAreaPreservingParameterization", {"Input": "disk"},
           outputs=["Surface", "Flat"], panel=["Seams", "Resolution", "Polish", "Corners", "Threading"],
           refused=("Resolution", 0, 12), quick=dict(Resolution=32),
           saved=dict(Seams="None", Corners=[2, 13, 39, 21], Resolution=24, Polish=0, Threading="Serial"),
           shown=[("View", {"type": "None", "port": "1"}),
                  ("FirstDisplay", {"port": "0", "type": "Checkerboard", "array": ""}),
                  ("FirstDisplay", {"port": "1", "type": "Checkerboard With Edges", "array": ""})],
           of_disks={"Seams": "None"}, slow_at_highest=("Resolution",)),
    Filter("Sample Surface", "vtkSurfaceSampler", {"Input": "disk"},
           panel=["NumberOfParticles", "Method", "RelaxationIterations", "SeedPattern", "RandomSeed",
                  "Resolution", "Corners", "DensityArray", *FLOW_PANEL, "Threading"],
           refused=("NumberOfParticles", 0, 9), quick=dict(NumberOfParticles=40, Resolution=32),
           saved=dict(NumberOfParticles=321, Method="Flow", RelaxationIterations=7,
                      DensityArray=["POINTS", "Height"], SeedPattern="Jittered", RandomSeed=7,
                      Corners=[2, 13, 39, 21], Resolution=24, NumberOfSteps=9),
           shown=PARTICLES, choices={"Method": ["Relaxation", "Flow"]}, of_disks={"Method": "Flow"},
           shown_at={"0": ["RelaxationIterations"],
                     "1": ["SeedPattern", "Resolution", "Corners", *FLOW_PANEL]},
           slow_at_highest=("Resolution",)),
    Filter("Uniform Seeds", "vtkUniformSeedSource",
           panel=["Bounds", "Dimension", "NumberOfPoints", "Pattern", "RandomSeed", "Threading"],
           refused=("NumberOfPoints", 0, 9),
           quick=dict(NumberOfPoints=40, Dimension=3),
           saved=dict(Bounds=[0, 511, 0, 511, 0, 9], NumberOfPoints=500, Pattern="Jittered"),
           shown=PARTICLES, gives_figures=False),
    Filter("Density Equalizing Warp", "vtkDensityEqualizingWarp",
           {"Input": "mesh", "Density": "density"},
           panel=["Density", "Blend", "EqualizeAreas", *DENSITY_PANEL, "EmptyCells", "EmptyValue", "Margin", *TILED_PANEL],
           refused=("Blend", -0.5, 1),
           saved=dict(InvertDensity=1, Blend=0.25, EqualizeAreas=1, NumberOfSteps=9, Method="Optimal",
                      OptimalityTolerance=0.01, EmptyCells="Value",
                      EmptyValue=80, Margin=0.05),
           always_shown=("EqualizeAreas",), shown=[READING], defaults={"EmptyCells": "Mean"}),
    Filter("Transport Quality", "vtkTransportQuality",
           {"Input": "points", "Density": "density"},
           panel=["Density", "BlockSize", *DENSITY_PANEL, "Tables", "Threading"],
           refused=("BlockSize", -1, 3),
           saved=dict(InvertDensity=1, BlockSize=32),
           shown=[READING, ("View", {"type": "SpreadSheetView"})], gives_table=True),
    Filter("Relax Blue Noise", "vtkBlueNoiseRelaxation",
           {"Input": "mesh", "Density": "density"},
           panel=["Density", "Method", "MaximumIterations", "Tolerance", *DENSITY_PANEL, "Threading"],
           refused=("MaximumIterations", -1, 2),
           quick=dict(MaximumIterations=2),
           saved=dict(InvertDensity=1, Method="OptimalTransport", MaximumIterations=3, Tolerance=0.001),
           shown=[READING, *PARTICLES], always_shown=("Tolerance",),  # of another meaning than that of flows
           choices={"Method": ["GaussianBlueNoise", "OptimalTransport"]}),
    Filter("Cartogram", "vtkCartogram", {"Input": "map"}, {"Overlay": "mesh"},
           ["Regions", "Graticule", "Overlay"],
           panel=["Overlay", "MassArray", "RegionArray", "Projection", "Tolerance", "MinimumShare", "Blend",
                  "Resolution", "Margin", "EmptyCells", "EmptyValue", "MaximumIterations", "Threading"],
           refused=("Blend", -0.5, 1), quick=dict(Resolution=64),
           saved=dict(Resolution=60, Projection="EqualArea", Tolerance=0.05, MinimumShare=0.001, Blend=0.5,
                      Margin=0.2, EmptyCells="Value", EmptyValue=0.5, MaximumIterations=3),
           always_shown=("Tolerance",),  # of another meaning than that of flows
           defaults={"EmptyCells": "Mean"}, slow_at_highest=("Resolution",),
           shown=[("FirstDisplay", {"port": "0", "type": "Filled Outlines With Edges",
                                    "array": "MassPerArea", "log": "10"}),
                  ("FirstDisplay", {"port": "1", "array": ""})]),
]


class Property(NamedTuple):
    """A property, whichever filters have it."""
    choices: list = []         # the first is the default; no version changes them
    animateable: bool = False
    advanced: bool = False     # in the panel of every filter
    shown_by: tuple = ()       # the properties one of which decides whether it is shown (or enabled)
    differing: tuple = ()      # two values that give different results where it is shown
    needs_large: bool = False  # these do so for large grids and many particles only


PATTERNS = ["BlueNoise", "Lattice", "Jittered", "LowDiscrepancy", "Random"]
PROPERTIES = {
    "SeedPattern": Property(PATTERNS),
    "Pattern": Property(PATTERNS),
    "NegativeValues": Property(["Error", "Clamp"]),
    "NaNValues": Property(["Error", "Empty"], advanced=True),
    "ValidRange": Property(advanced=True),
    "EmptyCells": Property(["Zero", "Mean", "Minimum", "Value"], advanced=True),
    "EmptyValue": Property(advanced=True, shown_by=("EmptyCells",), differing=(0.0, 2.0)),
    "Margin": Property(advanced=True),
    "Method": Property(["RectifiedFlow", "Optimal"]),
    "Seams": Property(["Auto", "None"]),
    "OptimalityTolerance": Property(advanced=True, shown_by=("Method", "Certify")),
    "Certify": Property(advanced=True),
    "Integrator": Property(["Multistep", "RungeKutta4", "Euler", "Adaptive"], advanced=True),
    "NumberOfSteps": Property(advanced=True, shown_by=("Integrator",), differing=(32, 1)),
    "AreaTolerance": Property(advanced=True, shown_by=("Integrator", "NumberOfSteps"), differing=(0.5, 1e-5)),
    "Tolerance": Property(advanced=True, shown_by=("Integrator",), differing=(0.01, 2.0)),
    "TableLookup": Property(["Interpolated", "Nearest"], advanced=True),
    "FlowMaps": Property(["Auto", "On", "Off"], advanced=True, shown_by=("Integrator",), differing=(1, 2),
                         needs_large=True),
    "Tables": Property(["Auto", "Whole", "Tiled"], advanced=True),
    "Device": Property(["CPU", "OpenCL"], advanced=True),
    "DeviceName": Property(advanced=True, shown_by=("Device",)),  # both change the time alone
    "Threading": Property(["Auto", "VTK", "OpenMP", "Serial"], advanced=True),
    "Projection": Property(["None", "EqualArea"]),
    "Direction": Property(["UniformToDensity", "DensityToUniform"]),
    "EqualizeAreas": Property(shown_by=("Direction",), differing=(0, 1)),
    "MassDifference": Property(["Normalize", "Error"]),
    "InputNames": Property(advanced=True),
    "ResultArrayName": Property(advanced=True),
    "MassMode": Property(["Linear", "Geometric", "Source", "Normalize"]),
    "Kernel": Property(["CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"]),
    "Radius": Property(shown_by=("Kernel",), differing=(1.0, 3.0)),
    "Boundary": Property(["Renormalize", "Drop"]),
    "Association": Property(["Points", "Cells"]),
    "OpenSurfaces": Property(["Error", "WindingNumber"]),
    "Order": Property(["File", "Path"]),
    "Shape": Property(["Flow", "Power"]),
    "Measure": Property(["Uniform", "Density"]),
    "SamplesPerCell": Property(shown_by=("SeedPattern",), differing=(0, 2)),
    "RandomSeed": Property(shown_by=("SeedPattern", "Pattern"), differing=(1, 2)),
    "PublishTime": Property(),
    "NumberOfTimeSteps": Property(shown_by=("PublishTime",), differing=(11, 5)),
    "Parameter": Property(animateable=True, shown_by=("PublishTime",), differing=(0.5, 0.25)),
    "Component": Property(shown_by=("DensityArray",), differing=(-1, 0)),
    "FlowTime": Property(animateable=True),
    "Blend": Property(animateable=True),
    "Weights": Property(animateable=True),
}


def by_label(label):
    return next(filter_ for filter_ in FILTERS if filter_.label == label)


def by_class(name):
    return next(filter_ for filter_ in FILTERS if filter_.class_name == name)


def of_kind(*kinds):
    """The filters that have an input of one of some kinds, each with the first port of that."""
    return [(filter_, filter_.port_of(*kinds)) for filter_ in FILTERS
            if filter_.port_of(*kinds) is not None]


def with_property(name):
    """The filters that have a property."""
    return [filter_ for filter_ in FILTERS if name in filter_.panel]
