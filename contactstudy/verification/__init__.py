"""Named cases with a reference beside each computed value; ``cases`` lists them all."""
