"""Lane values: one source for scalars, vectors and plain NumPy.

=========== =============================================================
module      responsibility
=========== =============================================================
lanes       the lane value, its arithmetic, load and store
lane_math   elementary and saturating functions with stated errors
lane_tables tables in memory: two points in one look, what is needed soon
vectors     three-vectors of lane values, wrenches and twists
solve       the 6x6 system of one roller
=========== =============================================================
"""
