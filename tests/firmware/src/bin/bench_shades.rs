//! Prints the cost of the frames of the bench scenes of light, colour, blending, fog, lines and
//! points, and of a scissor. It is 0 on the host, where nothing counts instructions.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::shades::main::<false>);
