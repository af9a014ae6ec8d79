//! Fixed-point rasterizer.
#![no_std]

#[cfg(test)]
extern crate std;

pub mod camera;
pub mod geometry;
pub mod mesh;
pub mod numbers;
pub mod raster;
pub mod scene;
pub mod shade;
pub mod target;
