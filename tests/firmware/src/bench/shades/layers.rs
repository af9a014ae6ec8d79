//! Spheres one behind the other, from the farthest to the nearest, so that each of them is drawn
//! over: by depth alone, and shaded once after all are drawn.

use core::{cell::RefCell, convert::Infallible};

use critical_section::Mutex;
use rasterizer::{
    attribute::NoDepth,
    camera::Camera,
    geometry::{Pose, ScreenVertex},
    numbers::{Scalar, Vec3},
    output::{Frame, Rgb565Be},
    scene::Object,
    shade::{Deferred, Gouraud, Phong, Shader, Visibility, VisibleTriangle},
};

use super::{LAMP, Scenes, VERTICES};
use crate::{
    bench::{AREA, MODES, PIXELS, SUITED, Suited, sun},
    cost::fail,
    models,
};

/// How many spheres there are.
const LAYERS: u8 = 6;

/// What is seen at each pixel, and its depth.
struct Visible {
    pixels: [VisibleTriangle; PIXELS],
    depth: [u16; PIXELS],
}

static VISIBLE: Mutex<RefCell<Visible>> = Mutex::new(RefCell::new(Visible {
    pixels: [VisibleTriangle::NONE; PIXELS],
    depth: [0; PIXELS],
}));

/// The numbers of the layers and their poses, a quarter of a unit nearer to the camera each.
fn layers(front: Pose) -> impl Iterator<Item = (u8, Pose)> {
    (0..LAYERS).map(move |layer| {
        let way = Scalar::from_num(LAYERS - 1 - layer) / 4;
        (layer, front.at(Vec3::new(Scalar::ZERO, Scalar::ZERO, -way)))
    })
}

/// Draws all layers into a visibility buffer.
fn draw_visible(front: Pose, camera: &Camera, visible: &mut Visible) -> Result<(), Infallible> {
    let mut vertices = [ScreenVertex::<Suited, u16, [u16; 0]>::EMPTY; VERTICES];
    visible.pixels.fill(VisibleTriangle::NONE);
    let frame = Frame::new(&mut visible.pixels, &mut visible.depth, AREA);
    let mut frame = frame.unwrap_or_else(fail);
    frame.clear_depth();
    layers(front).try_for_each(|(layer, pose)| {
        let sphere = Object::new(&models::SPHERE, Visibility::of_object(layer).without_weights())
            .posed(pose);
        sphere.project(camera, &mut vertices).unwrap_or_else(fail).draw(&mut frame)
    })
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn layers(&mut self) {
        self.layered(["layers-gouraud", "layers-gouraud-deferred"], Gouraud::new(sun()));
        self.layered(
            ["layers-phong-lamp", "layers-phong-lamp-deferred"],
            Phong::new((sun(), LAMP)),
        );
    }

    fn layered<Sh: Shader<Color = Rgb565Be> + Copy>(
        &mut self,
        [direct, deferred]: [&str; 2],
        shader: Sh,
    ) {
        let sphere = Object::new(&models::SPHERE, shader);
        let (camera, mode) = (&self.camera, MODES[0].name);
        self.bench.measure::<Suited, u16, _, _>(
            [direct, SUITED, mode],
            &sphere,
            |cost, object, vertices, _, memory| {
                cost.add_steps(object, camera, vertices, memory, |vertices, frame| {
                    layers(*object.pose()).try_for_each(|(_, pose)| {
                        object
                            .posed(pose)
                            .project(camera, vertices)
                            .unwrap_or_else(fail)
                            .draw(frame)
                    })
                });
            },
        );
        self.bench.measure::<Suited, NoDepth, _, _>(
            [deferred, SUITED, mode],
            &sphere,
            |cost, object, vertices, _, memory| {
                cost.add_steps(object, camera, vertices, memory, |vertices, frame| {
                    critical_section::with(|token| {
                        let visible = &mut *VISIBLE.borrow_ref_mut(token);
                        draw_visible(*object.pose(), camera, visible)?;
                        layers(*object.pose()).try_for_each(|(layer, pose)| {
                            let shader = Deferred::new(shader, layer, &visible.pixels, AREA);
                            let object = Object::new(&models::SPHERE, shader).posed(pose);
                            object.project(camera, vertices).unwrap_or_else(fail).draw(frame)
                        })
                    })
                });
            },
        );
    }
}
