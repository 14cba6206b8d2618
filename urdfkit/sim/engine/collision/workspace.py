"""Layout of the working memory for a pair: starts of fields in the two arrays of the caller."""

import numpy as np

MOST_POINTS, MOST_FACES, MOST_CORNERS, MOST_CANDIDATES = 128, 256, 64, 64
"""Room for the polytope's points and faces, for the corners of a face, for contacts before they are reduced."""
NONE = np.int64(0)
MOST_CLIPPED = 2 * MOST_CORNERS

# Floats. The first points are also the simplex. All are numpy integers, because numba compiles a function again for
# each Python constant that it is called with.
DIFFERENCE = np.int64(0)
ON_A = DIFFERENCE + 3 * MOST_POINTS
FACE_NORMAL = ON_A + 3 * MOST_POINTS
FACE_DISTANCE = FACE_NORMAL + 3 * MOST_FACES
POLYGON_A = FACE_DISTANCE + MOST_FACES
POLYGON_B = POLYGON_A + 3 * MOST_CORNERS
CLIPPED = POLYGON_B + 3 * MOST_CORNERS
CLIPPED_NEXT = CLIPPED + 3 * MOST_CLIPPED
POINT = CLIPPED_NEXT + 3 * MOST_CLIPPED
NORMAL = POINT + 3 * MOST_CANDIDATES
GAP = NORMAL + 3 * MOST_CANDIDATES
WORK = int(GAP + MOST_CANDIDATES)
"""Floats of working memory that `collide_pair` needs."""

# Integers.
FACE_POINT = np.int64(0)
HORIZON = FACE_POINT + 3 * MOST_FACES
ID_A = HORIZON + 2 * MOST_FACES
ID_B = ID_A + MOST_CORNERS
CLIPPED_ID = ID_B + MOST_CORNERS
CLIPPED_ID_NEXT = CLIPPED_ID + MOST_CLIPPED
FEATURE = CLIPPED_ID_NEXT + MOST_CLIPPED
STACK = FEATURE + MOST_CANDIDATES
OTHER_STACK = STACK + 64
WORK_INDICES = int(OTHER_STACK + 64)
"""Integers of working memory that `collide_pair` needs."""
