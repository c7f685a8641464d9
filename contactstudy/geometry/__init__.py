"""Where two bodies stand and meet: poses, first touch, contact points, candidate facets."""
