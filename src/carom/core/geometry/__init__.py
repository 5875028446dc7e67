"""Surfaces a ball can touch, as numbers: faces, lines, points, circles, ellipses, polygons; gaps, normals, times of contact."""
