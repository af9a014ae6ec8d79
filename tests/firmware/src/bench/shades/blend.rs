//! Blending: the sphere with each mode, with alphas by vertex and by texel, and from back to front.

use rasterizer::{
    attribute::NoDepth,
    color::Alpha,
    geometry::{CullBack, CullNone, Culling},
    mesh::MeshVertex,
    output::{Add, KeepDepth, MaterialOpacity, Multiply, Over, Rgb565Be, Screen},
    scene::{Mode, Object},
    shade::{Faded, Gouraud, Shader, Textured},
    texture::{Bilinear, Colors, Texture, Translucent},
};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited, sun},
    cost::{Depth, OnTargets},
    models,
};

/// The cube's picture with an alpha plane: all of its 128 x 128 texels are half.
type Veil = Texture<Translucent<'static, Colors<'static, Rgb565Be, 16_384>, 8, 16_384>, 128, 128>;
static VEIL: [Veil; 1] = {
    static PLANE: [u8; 16_384] = [128; 16_384];
    static COLORS: [Rgb565Be; 16_384] = [Rgb565Be::new(20, 30, 10); 16_384];
    [Texture::new(Translucent::new(Colors::new(&COLORS), &PLANE))]
};

/// From 0 at one pole to 1 at the other.
fn along(vertex: &MeshVertex<'_>) -> Alpha {
    let [_, y, _] = vertex.position();
    Alpha::from_bits(((i32::from(y) + 32_768) >> 8) as u16)
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn blend(&mut self) {
        const PART: Alpha = Alpha::lit("0.4");
        let gouraud = Gouraud::new(sun());
        self.blended::<u16, _, _>("sphere-over", gouraud, CullBack, Over(PART));
        self.blended::<u16, _, _>("sphere-add", gouraud, CullBack, Add(PART));
        self.blended::<u16, _, _>("sphere-multiply", gouraud, CullBack, Multiply(PART));
        self.blended::<u16, _, _>("sphere-screen", gouraud, CullBack, Screen(PART));
        self.blended::<u16, _, _>(
            "sphere-over-keep-depth",
            gouraud,
            CullBack,
            KeepDepth(Over(PART)),
        );
        let by_material = Over(MaterialOpacity::times(PART));
        self.blended::<u16, _, _>("sphere-over-material", gouraud, CullBack, by_material);
        let faded = Faded::new(gouraud, along);
        self.blended::<u16, _, _>("sphere-over-vertex", faded, CullBack, Over(Alpha::OPAQUE));
        self.blended::<NoDepth, _, _>("sphere-over-no-depth", gouraud, CullNone, Over(PART));
        self.sorted("sphere-over-back-to-front", gouraud, CullNone, Over(PART));
        let veil = Textured::new(&VEIL);
        self.on::<u16, _, _>(
            "cube-over-texel",
            Object::new(&models::CUBE_TEXTURE, veil).blended(Over(Alpha::OPAQUE)),
        );
        self.on::<u16, _, _>(
            "cube-over-texel-bilinear",
            Object::new(&models::CUBE_TEXTURE, veil.filtered(Bilinear))
                .blended(Over(Alpha::OPAQUE)),
        );
    }

    fn blended<D: Depth, Sh: Shader<Color = Rgb565Be>, B: OnTargets<D>>(
        &mut self,
        name: &str,
        shader: Sh,
        culling: impl Culling,
        blending: B,
    ) {
        let object = Object::new(&models::SPHERE, shader).culled(culling).blended(blending);
        self.on::<D, _, _>(name, object);
    }

    /// The whole frame in the mesh's order.
    fn on<D: Depth, Sh: Shader<Color = Rgb565Be>, M: Mode<Blending: OnTargets<D>>>(
        &mut self,
        name: &str,
        object: Object<'_, Sh, M>,
    ) {
        let (camera, mode) = (&self.camera, [name, SUITED, MODES[0].name]);
        self.bench.measure::<Suited, D, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_blended(object, camera, vertices, None, memory);
            },
        );
    }

    /// The whole frame, sorted and without depth.
    fn sorted<Sh: Shader<Color = Rgb565Be>, B: OnTargets<NoDepth>>(
        &mut self,
        name: &str,
        shader: Sh,
        culling: impl Culling,
        blending: B,
    ) {
        let object = Object::new(&models::SPHERE, shader).culled(culling).blended(blending);
        let (camera, mode) = (&self.camera, [name, SUITED, MODES[0].name]);
        self.bench.measure::<Suited, NoDepth, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                let mut order = [0; SPHERE_TRIANGLES];
                cost.add_blended(object, camera, vertices, Some(&mut order), memory);
            },
        );
    }
}

const SPHERE_TRIANGLES: usize = models::SPHERE.triangle_count();
