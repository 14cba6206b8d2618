"""Our engine beside MuJoCo and PyBullet: the same scenes, the same step, in turns."""
