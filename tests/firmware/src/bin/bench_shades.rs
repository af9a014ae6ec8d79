//! Prints the cost of the frames of the bench scenes of light, colour, blending, fog, lines and
//! points, of a scissor, of layers that are shaded once, and of several samples a pixel. On the
//! host it is in nanoseconds.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::shades::main::<false>);
