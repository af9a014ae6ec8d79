//! All tests of the rasterizer together with its host tools, in one program: what they share is
//! compiled and linked once.
//!
//! `cargo test --package rasterizer-tests lights` runs those of the file `lights.rs`.
//!
//! The narrow arithmetic of `.ci/narrow` changes products, quotients, leading zeros, the parts of a
//! row and how a row is filled. A test stays out there if it compares colours, calls or texts that
//! come after all of these, of pictures that other tests draw in that arithmetic.

mod any_shader;
mod arithmetic;
mod arms;
mod back_to_front;
mod bands;
mod billboards;
#[cfg(not(rasterizer_narrow))]
mod blobs;
mod claimed_cells;
mod clip_planes;
mod clipping;
#[cfg(not(rasterizer_narrow))]
mod compile_fail;
mod coverage;
mod depth_formats;
#[cfg(not(rasterizer_narrow))]
mod dithering;
mod errors;
mod extremes;
mod frames;
#[cfg(not(rasterizer_narrow))]
mod keyframe_files;
mod lights;
mod lines;
mod matrices;
mod metamorphic;
mod mip_levels;
#[cfg(not(rasterizer_narrow))]
mod model_files;
mod morph;
mod moving;
mod object_lines;
mod packed_frames;
mod painter;
mod particles;
mod parts;
mod parts_sides;
mod perspective;
mod picking;
mod pictures;
mod placement;
mod placement_table;
mod points;
mod scenes;
mod scissor;
mod seam;
#[cfg(not(rasterizer_narrow))]
mod sending;
mod shadows;
mod shapes;
mod smooth_lines;
mod supersampling;
mod targets;
mod textured_frames;
mod unclipped;
mod visibility;
mod window_ends;
#[cfg(not(rasterizer_narrow))]
mod written_tables;

/// A file that is no module here would be a test that never runs.
#[test]
fn every_file_of_tests_is_a_module() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let names = std::fs::read_dir(folder).unwrap().map(|entry| {
        let path = entry.unwrap().path();
        path.file_stem().unwrap().to_string_lossy().into_owned()
    });
    let missing: Vec<_> = names
        .filter(|name| name != "all" && !include_str!("all.rs").contains(&format!("\nmod {name};")))
        .collect();
    assert!(missing.is_empty(), "all.rs has no `mod` for {missing:?}");
}
