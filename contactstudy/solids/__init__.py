"""Three-dimensional elasticity: hexahedral meshes and their condensation to superelements."""
