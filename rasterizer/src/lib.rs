//! A fixed-point 3D rasterizer for microcontrollers, drawing through [`embedded-graphics`].
//!
//! It needs no heap, no FPU and no operating system. A model is a [`Mesh`] of constant tables in
//! flash, which this project's `host-tools` make from an OBJ file. The caller owns all memory: a
//! colour and a depth buffer for the picture or for a band of its rows (4 bytes per pixel with
//! RGB565 and 16-bit depth), 8 to 16 bytes for each vertex of the largest mesh, or none, and a bit
//! for each of its triangles and bands, or none. [`Needs`](scene::Needs) gives all these lengths at
//! compile time.
//!
//! # Example
//!
//! A square of two triangles, seen by a camera three units in front of it, turned by a few degrees:
//!
//! ```
//! use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
//! use rasterizer::{
//!     mesh::{Material, Mesh, Positions, Tables, Triangles},
//!     numbers::Vec3,
//!     prelude::*,
//! };
//!
//! static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
//!     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
//!     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
//!     materials: &[Material::new([255, 160, 0], 2)],
//!     ..Tables::EMPTY
//! });
//!
//! // In constants, so that the compiler reads the texts.
//! const NEAR: Distance = Distance::lit("0.1");
//! const FAR: Distance = Distance::lit("10");
//! const EYE: Vec3 = Vec3::lit("0", "0", "3");
//!
//! let display = Rectangle::new(Point::zero(), Size::new(16, 8));
//! let lens = Perspective::new(Turn::degrees(40), NEAR, FAR)?;
//! let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, display)?;
//!
//! let mut color = [Rgb565::BLACK; 16 * 8];
//! let mut depth = [0u16; 16 * 8];
//! let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; SQUARE.vertex_count()];
//!
//! let mut frame = Frame::new(&mut color, &mut depth, display)?;
//! Object::new(&SQUARE, Unlit::new())
//!     .posed(Pose::rotated(Rotation::about_z(Turn::degrees(20))))
//!     .draw(&camera, &mut vertices, &mut frame)?;
//!
//! let picture: Vec<String> = frame
//!     .pixels()
//!     .chunks(16)
//!     .map(|row| row.iter().map(|&p| if p == Rgb565::BLACK { '.' } else { '#' }).collect())
//!     .collect();
//! assert_eq!(
//!     picture,
//!     [
//!         ".......####.....",
//!         "....#######.....",
//!         "....#######.....",
//!         "....########....",
//!         "....########....",
//!         ".....#######....",
//!         ".....#######....",
//!         ".....####.......",
//!     ]
//! );
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! On a device the last step is `frame.present(&mut display)`, for any [`DrawTarget`]. The frame is
//! a [`DrawTarget`] too: text, primitives and images of `embedded-graphics` can be drawn under the
//! objects and over them. Where there is no room for all pixels, draw in bands of rows:
//!
//! ```
//! # use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
//! # use rasterizer::{
//! #     mesh::{Material, Mesh, Positions, Tables, Triangles},
//! #     numbers::Vec3,
//! #     prelude::*,
//! # };
//! # static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
//! #     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
//! #     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
//! #     materials: &[Material::new([255, 160, 0], 2)],
//! #     ..Tables::EMPTY
//! # });
//! # let screen = Rectangle::new(Point::zero(), Size::new(16, 8));
//! # let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.1"), Distance::lit("10"))?;
//! # let camera = Camera::look_at(Vec3::lit("0", "0", "3"), Vec3::ZERO, Vec3::Y, lens, screen)?;
//! # let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; SQUARE.vertex_count()];
//! # let mut display = std::vec::Vec::new();
//! # struct Display<'a>(&'a mut std::vec::Vec<Rgb565>);
//! # impl OriginDimensions for Display<'_> {
//! #     fn size(&self) -> Size { Size::new(16, 8) }
//! # }
//! # impl DrawTarget for Display<'_> {
//! #     type Color = Rgb565;
//! #     type Error = core::convert::Infallible;
//! #     fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Self::Error>
//! #     where
//! #         I: IntoIterator<Item = Pixel<Rgb565>>,
//! #     {
//! #         self.0.extend(pixels.into_iter().map(|pixel| pixel.1));
//! #         Ok(())
//! #     }
//! # }
//! # let mut display = Display(&mut display);
//! // Two rows at a time; the four bands take the bits of two triangles.
//! let (mut color, mut depth) = ([Rgb565::BLACK; 16 * 2], [0u16; 16 * 2]);
//! let mut bins = [0; 4];
//! let seen = Object::new(&SQUARE, Unlit::new()).project(&camera, &mut vertices)?;
//! let seen = seen.binned(2, &mut bins)?;
//! Bands::new(screen, &mut color, &mut depth)?.show(
//!     &mut display,
//!     |band| band.clear_color(Rgb565::BLACK),
//!     |band| seen.draw(band),
//! )?;
//! # assert_eq!(display.0.len(), 16 * 8);
//! # assert!(display.0.iter().filter(|&&pixel| pixel != Rgb565::BLACK).count() > 40);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! The first closure draws the background of a band, here of one colour; the second draws the
//! objects.
//!
//! # The way through the crate
//!
//! Data goes one way: the modules stand in its order, and each uses only those above it.
//! `ARCHITECTURE.md` in the repository follows one vertex and one pixel through them.
//!
//! | module | what it does |
//! |---|---|
//! | [`numbers`] | Q formats, vectors, rotations, reciprocal and roots, sub-pixels |
//! | [`mesh`] | const tables in flash |
//! | [`camera`] | place, direction, projection, viewport |
//! | [`attribute`] | depth and varyings of a vertex, and their interpolation |
//! | [`color`] | alpha, blending formulas, dithering, colours of vertices, a colour of a byte |
//! | [`texture`] | texels in flash: formats, borders, filters, mip levels |
//! | [`geometry`] | object space to vertices on the screen: transform, clipping, culling |
//! | [`raster`] | triangles to spans of fragments: edges, rows, gradients |
//! | [`shade`] | the colours of fragments |
//! | [`output`] | the pixels' destination: memory, or a display directly; depth test, blending |
//! | [`scene`] | objects with their shaders; drives all of the above |
//!
//! # Choices are types
//!
//! What a scene needs is chosen by types at compile time. What it does not need is not in its
//! firmware.
//!
//! | choice | by | |
//! |---|---|---|
//! | sub-pixel precision | the type of the vertex storage | [`S4`](numbers::S4), [`S8`](numbers::S8) |
//! | depth | the type of the depth buffer | `u16`, [`FloatDepth`](attribute::FloatDepth), `u32`, [`NoDepth`](attribute::NoDepth) |
//! | how a camera moves | what makes it | [`Camera::look_at`](camera::Camera::look_at) and others, [`Orbit`](camera::Orbit), [`FirstPerson`](camera::FirstPerson) |
//! | projection | the camera's type | [`Perspective`](camera::Perspective), [`Orthographic`](camera::Orthographic) |
//! | faces left out | [`Object::culled`](scene::Object::culled) | [`CullBack`](geometry::CullBack), [`CullFront`](geometry::CullFront), [`CullNone`](geometry::CullNone) |
//! | triangles cut or left out | [`Object::clipped`](scene::Object::clipped) | [`ClipAll`](geometry::ClipAll), [`ClipNone`](geometry::ClipNone) for objects that stay between the clip planes, or [`ClipPlanes`](geometry::ClipPlanes) with planes of your own, in world or object space |
//! | new and stored colours | [`Object::blended`](scene::Object::blended) | [`Replace`](output::Replace); [`Over`](output::Over), [`Add`](output::Add), [`Multiply`](output::Multiply), [`Screen`](output::Screen); [`Blend`](output::Blend) by a function of both |
//! | depth of blended pixels | the blending | stored, or with [`KeepDepth`](output::KeepDepth) left |
//! | depth of triangles | [`Object::biased`](scene::Object::biased) | theirs, or moved by a [`Bias`](raster::Bias) |
//! | lines | a table of vertices, [`Lines`](mesh::Lines) | [`Projected::lines`](scene::Projected::lines): in one colour or by the shader, over the triangles or alone; hidden ones left out after [`draw_depth`](scene::Projected::draw_depth); antialiased by [`smooth`](scene::ProjectedLines::smooth) |
//! | points | a table of vertices, [`Points`](mesh::Points) | [`Projected::points`](scene::Projected::points): squares of a size in pixels, in one colour or by the shader |
//! | as modelled, or stretched, mirrored, sheared | [`Object::shaped`](scene::Object::shaped) | [`AsModelled`](geometry::AsModelled), or a [`Matrix`](numbers::Matrix) by [`Shaped`](geometry::Shaped) |
//! | shapes chosen at run time | [`Object::in_any_shape`](scene::Object::in_any_shape) | [`AnyShape`](geometry::AnyShape): objects of all shapes in one array |
//! | one shape, or between two | [`Object::morphed`](scene::Object::morphed) | a [`Tween`](mesh::Tween) of a mesh's [`Keyframes`](mesh::Keyframes) |
//! | vertices in flash, or in RAM where they move | what the mesh is made by | [`Mesh::new_const`](mesh::Mesh::new_const), [`Mesh::from_bytes`](mesh::Mesh::from_bytes), [`MovingMesh`](mesh::MovingMesh) |
//! | alpha | the blending's factor, the shader, the texels | an [`Alpha`](color::Alpha) for the object, [`MaterialOpacity`](output::MaterialOpacity), [`Faded`](shade::Faded) by vertices, [`Translucent`](texture::Translucent) by texels |
//! | colour | the shader's type | [`Unlit`](shade::Unlit), [`Flat`](shade::Flat), [`Gouraud`](shade::Gouraud), [`GlossyGouraud`](shade::GlossyGouraud), [`Phong`](shade::Phong), [`Textured`](shade::Textured), [`TexturedFlat`](shade::TexturedFlat), [`TexturedGouraud`](shade::TexturedGouraud), [`Colored`](shade::Colored), [`ColoredGouraud`](shade::ColoredGouraud), [`Matcap`](shade::Matcap), or [your own](shade::Shader) |
//! | the triangle that is seen at a pixel | a shader | [`Visibility`](shade::Visibility); [`Deferred`](shade::Deferred) shades those pixels alone |
//! | fog | a shader around another one | [`Fogged`](shade::Fogged), [`AtPixels`](shade::AtPixels) or [`AtVertices`](shade::AtVertices) |
//! | an object's own colour, or place of a texture | a shader around another one, a texture around another one | [`Recolored`](shade::Recolored), [`Offset`](texture::Offset) |
//! | texels | the texture's type | [formats](texture), sizes, and borders: [`Repeat`](texture::Repeat), [`Mirror`](texture::Mirror), [`Clamp`](texture::Clamp) |
//! | texels of a pixel | the shader's filter | [`Nearest`](texture::Nearest), [`Bilinear`](texture::Bilinear), [`NearestMip`](texture::NearestMip), [`BilinearMip`](texture::BilinearMip), [`Trilinear`](texture::Trilinear) |
//! | perspective of texture coordinates | the shader's mode, by `corrected` | [`Affine`](attribute::Affine), [`Every`](attribute::Every), [`Adaptive`](attribute::Adaptive), [`EveryPixel`](attribute::EveryPixel); of any varying by [`PerspectiveCorrect`](attribute::PerspectiveCorrect) |
//! | pixels discarded or not | the shader's [`Outcome`](shade::Shader::Outcome) | a colour, an `Option` of one, or a [`Layer`](shade::Layer) with an alpha |
//! | colours of the display | the shader's colour type | all of embedded-graphics, [`Rgb332`](color::Rgb332), or your own: [`color`] has a table of them |
//! | dithering | a wrapper of the shader, or of the display | [`Dithered`](shade::Dithered), [`Dithering`](output::Dithering) |
//! | byte order of a pixel | the shader's colour type | [`Rgb565Be`](output::Rgb565Be), in SPI order and filled by words, or [any other](output::StoredColor) |
//! | vertices stored or not | a method of the object | [`project`](scene::Object::project), [`project_on_demand`](scene::Object::project_on_demand) |
//! | order of triangles | a step before drawing | [`MeshOrder`](scene::MeshOrder), [`Bins`](scene::Bins) by [`Projected::binned`](scene::Projected::binned), [`InParts`](scene::InParts) by [`Projected::in_parts`](scene::Projected::in_parts), or [`BackToFront`](scene::BackToFront) by [`Projected::back_to_front`](scene::Projected::back_to_front); several objects by [`Painter`](scene::Painter) |
//! | destination | the target's type | [`Frame`](output::Frame), [`Bands`](output::Bands) of it, [`Direct`](output::Direct) |
//! | pixels of less than a byte | the target's type | [`PackedFrame`](output::PackedFrame), [`Bands::packed`](output::Bands::packed); [`InRows`](output::InRows) or [`InPages`](output::InPages) |
//! | pixels that may change | a wrapper of the target | all of it, or those in a rectangle: [`Scissored`](output::Scissored) |
//! | each pixel once, where triangles overlap | a wrapper of the target | [`Once`](output::Once), with a bit for each pixel |
//! | shapes without a file | constants | [`mesh::shapes`] |
//! | billboards | a mesh and a pose | [`Card`](mesh::Card), [`Pose::facing`](geometry::Pose::facing) the camera, sized in units or [in pixels](geometry::Pose::in_pixels) |
//! | particles | [`Particles::new`](scene::Particles::new) | a slice of them: [`Squares`](shade::Squares), pictures ([`Frames`](shade::Frames)); from back to front or as they come |
//! | shadow on a plane | [`Object::clipped`](scene::Object::clipped) | [`PlanarShadow`](geometry::PlanarShadow): the object's shadow in its place; [`LampShadow`](geometry::LampShadow) in the light of a lamp |
//! | samples a pixel | the constructor of the bands | 1, or 2 x 2 and 4 x 4 with [`Bands::supersampled`](output::Bands::supersampled); [`Frame::resolved`](output::Frame::resolved) |
//! | rows of a frame | its constructor | [`Packed`](output::Packed), or [`Strided`](output::Strided) in a larger buffer by [`with_stride`](output::Frame::with_stride) |
//!
//! # Conventions
//!
//! ```text
//!        y                                       (0,0)───────── x, columns
//!        │     world and object space:             │  ┌────┬────┐
//!        │     right-handed, as in OBJ             │  │ ·  │ ·  │   display: y runs down,
//!        └──── x                                   │  ├────┼────┤   pixel (i, j) has its centre
//!       ╱                                          │  │ ·  │ ·  │   at (i + 1/2, j + 1/2)
//!      z  towards the viewer                       y  └────┴────┘
//! ```
//!
//! * The camera looks along its own -z. Front faces run counter-clockwise on the screen.
//! * Vectors are columns, matrices multiply from the left: `(a * b) * v` turns v by b, then by a.
//! * Angles are turns in Q0.32; positive ones turn x to y about z, y to z about x, z to x about y.
//! * A pixel is covered if its centre is inside a triangle; a centre on an edge belongs to the
//!   triangle whose top or left edge it is. So triangles that share an edge share no pixel and
//!   leave none out, and blending along the edge changes each pixel once. This is decided exactly,
//!   on the snapped vertices; a vertex in the middle of another triangle's edge (a T-junction) may
//!   leave a gap one pixel wide, because snapping moves it off the edge.
//! * Depth is near / w: 1 on the near plane, 0 infinitely far away; larger is nearer, the buffer is
//!   cleared to 0, and the first pixel drawn wins a tie.
//! * Nothing before the near plane or beyond the far plane is visible. Triangles that reach there,
//!   or more than 1,024 pixels from the viewport's middle, are cut. For an object that never
//!   reaches there, `object.clipped(ClipNone)` leaves out the code that cuts, 2 to 3 KB; a triangle
//!   that does reach there is then left out whole.
//! * Colours are computed in the values that pictures store, without a gamma curve.
//!
//! # Numbers
//!
//! | what | format | range, error |
//! |---|---|---|
//! | world coordinates | Q16.16 | ±32,768; a step is f / w 2<sup>-16</sup> pixels, with the focal length f in pixels, from the distance w |
//! | directions, rotations | Q2.30 | orthonormal within 2<sup>-26</sup> |
//! | matrices that stretch, mirror or shear | Q16.16 | half a 65,536th for each product |
//! | quaternions | Q2.30 | 2<sup>-25</sup> radians on the [way](numbers::Quaternion::slerp) between two |
//! | positions in a mesh | 16 bits times the mesh's [`Scale`](numbers::Scale) | half a quantum: 1/131,068 of the longest side |
//! | places on the screen | sub-pixels, 4 or 8 bits behind the point | half a sub-pixel of snapping and 1/8 of arithmetic, for objects up to some hundred near distances wide with 4 bits, some hundred thousand with 8 ([`PoseError`](geometry::PoseError) has the limit, beyond which an object is refused); ±1,024 pixels about the viewport's middle |
//! | depth | Q0.16, Q0.32 or [floating-point](attribute::FloatDepth) in 16 bits, stepped with 16 or 18 more bits | 1 unit of the format |
//! | texture coordinates | Q2.14, or Q8.24 for up to 64 repeats from 0; near / w with them in Q0.32 | 1/16 texel or 1/256 pixel, whichever is more, where they are divided ([`EveryPixel`](attribute::EveryPixel)); the tolerance, half a texel unless another is chosen, with [`Adaptive`](attribute::Adaptive); for textures of up to 1,024 texels and distances of up to 1:1,000 in a triangle |
//! | mip levels | Q16.16 | 1/30 level for each pixel ([`PerPixel`](texture::PerPixel)) |
//! | light levels | Q0.16, stepped with 16 more bits | 1 of 256 steps of colour |
//! | level of a [`Lamp`](shade::Lamp) | Q0.16, directions in Q1.15 | 2<sup>-12</sup> |
//! | normal of a pixel ([`Phong`](shade::Phong)) | Q1.15 | half a degree |
//!
//! Any finite input gives the right picture or an error value before the first pixel: triangles
//! that leave the guard band of ±1,024 pixels, the near plane or the far plane are clipped, in
//! every shading mode. With [`ClipNone`](geometry::ClipNone) these triangles are missing, and
//! nothing else.
//!
//! # Not supported
//!
//! * Coloured light, normal maps, highlights on textures; shadows other than
//!   [on a plane](geometry::PlanarShadow), by a far light and by a lamp, and blobs.
//! * Antialiasing of triangles other than by [supersampling](output::Supersampled).
//! * Textures over 1,024 texels wide or high, and anisotropic filters.
//! * Bins of triangles that are sorted from back to front.
//! * Mirrors that show what lies before them, other than by a second object in a matrix.
//! * Controllers of cameras that roll; [`Camera::at`](camera::Camera::at) has any rotation.
//! * Texture coordinates of an [`Icosphere`](mesh::shapes::Icosphere).
//! * Viewports over 2,048 pixels wide or high; meshes of over 65,536 vertices.
//! * One storage for vertices of different types that are kept across the bands of a frame: each
//!   object has its own, or none ([`Object::project_on_demand`](scene::Object::project_on_demand),
//!   [`Scene`](scene::Scene)).
//!
//! # Features
//!
//! None: the compiler leaves out what a scene does not name.
//!
//! [`embedded-graphics`]: https://docs.rs/embedded-graphics
//! [`DrawTarget`]: embedded_graphics_core::draw_target::DrawTarget
//! [`Mesh`]: mesh::Mesh

#![no_std]

#[cfg(test)]
extern crate std;

pub mod attribute;
pub mod camera;
pub mod color;
pub mod geometry;
pub mod mesh;
pub mod numbers;
pub mod output;
pub mod prelude;
#[cfg(test)]
#[expect(dead_code, unreachable_pub, reason = "the project's other tests use it too")]
mod random;
pub mod raster;
pub mod scene;
pub mod shade;
pub mod texture;

// Their types are part of this crate's signatures: name them through here, and they are the
// versions that it is built with.
pub use bytemuck;
pub use embedded_graphics_core;
/// Fixed-point numbers. The newest version of it, which `cargo add fixed` takes, has other types
/// than the one that goes with [`embedded_graphics_core`].
pub use fixed;
pub use micromath;
