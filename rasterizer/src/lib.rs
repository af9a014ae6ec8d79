//! Fixed-point rasterizer.
#![no_std]

#[cfg(test)]
extern crate std;

pub mod mesh;
pub mod numbers;
