//! Scenes that are hard for a rasterizer, not for its user. They are made by code, as OBJ files.

use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use png::{BitDepth, ColorType, Encoder};

use super::scenes::Scene;

/// All of them.
///
/// # Errors
///
/// Returns an error if a file cannot be written.
pub(super) fn scenes(frames: u32) -> Result<Vec<Scene>> {
    let file = |name: &str| super::folder().map(|folder| folder.join(name).join(name));
    // The camera is above it, with a wide lens.
    let floor = Scene::of(&floor(&file("floor")?)?, frames)?;
    let floor = Scene { focal_length_px: 120, distance: 0.8, ..floor };
    Ok(vec![Scene::of(&labels(&file("labels")?)?, frames)?, floor])
}

/// How far a label lies before its side, in half the width of the cube: a quarter of a unit of
/// `u16` where the sides are, some twenty near distances away.
const GAP: f64 = 1.0 / 4096.0;

/// A cube with a label just before each of its sides. Depth of 16 bits cannot tell which is nearer,
/// nor can sorting.
fn labels(path: &Path) -> Result<PathBuf> {
    let mut text = String::from("mtllib labels.mtl\ns off\n");
    let mut corners = 0;
    for (material, half, height) in [("side", 1.0, 1.0), ("label", 0.7, 1.0 + GAP)] {
        let _ = writeln!(text, "usemtl {material}");
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
            for [right, up] in [[-half, -half], [half, -half], [half, half], [-half, half]] {
                // Counter-clockwise from outside.
                let mut corner = [0.0; 3];
                corner[axis] = sign * height;
                corner[(axis + 1) % 3] = right;
                corner[(axis + 2) % 3] = sign * up;
                let [x, y, z] = corner;
                let _ = writeln!(text, "v {x} {y} {z}");
            }
            let [a, b, c, d] = [1, 2, 3, 4].map(|corner| corners + corner);
            let _ = writeln!(text, "f {a} {b} {c} {d}");
            corners += 4;
        }
    }
    let colors = "newmtl side\nKd 0.15 0.3 0.65\nnewmtl label\nKd 0.9 0.85 0.5\n";
    write(path, "mtl", colors.into())?;
    write(path, "obj", text.into())
}

/// How often the floor's texture repeats along a side: coordinates of 16 bits reach from -2 to 2.
const REPEATS: f64 = 3.5;

/// A paved floor of two triangles that begins under the camera. It is magnified there; far away a
/// pixel has several texels along one axis and tens along the other.
fn floor(path: &Path) -> Result<PathBuf> {
    let end = REPEATS / 2.0;
    let text = format!(
        "mtllib floor.mtl\nusemtl paving\nvn 0 1 0\n\
         v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\n\
         vt -{end} -{end}\nvt {end} -{end}\nvt {end} {end}\nvt -{end} {end}\n\
         f 1/1/1 2/2/1 3/3/1 4/4/1\n"
    );
    write(path, "png", paving()?)?;
    write(path, "mtl", "newmtl paving\nmap_Kd floor.png\n".into())?;
    write(path, "obj", text.into())
}

/// Width and height of the floor's picture in texels.
const PAVING: u32 = 128;
/// Of a slab, with the joint around it.
const SLAB: u32 = 16;

/// Slabs of four colours, and the joints between them, as a PNG file.
fn paving() -> Result<Vec<u8>> {
    const JOINT: [u8; 3] = [50, 46, 42];
    const SLABS: [[u8; 3]; 4] = [[200, 182, 150], [168, 118, 88], [120, 130, 142], [188, 160, 92]];
    let texel = |place: u32| {
        let [x, y] = [place % PAVING, place / PAVING];
        let slab = (x / SLAB + 3 * (y / SLAB) + (x / SLAB) * (y / SLAB)) % 4;
        if x % SLAB == 0 || y % SLAB == 0 { JOINT } else { SLABS[slab as usize] }
    };
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, PAVING, PAVING);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data((0..PAVING * PAVING).map(texel).collect::<Vec<_>>().as_flattened())?;
    writer.finish()?;
    Ok(file)
}

/// Writes a file of a scene, and returns where it is.
fn write(path: &Path, extension: &str, bytes: Vec<u8>) -> Result<PathBuf> {
    let path = path.with_extension(extension);
    let folder = path.parent().context("a scene has a folder")?;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    write_atomically(&path, bytes)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use host_tools::check::{DepthFormat, TrueModel, View, render};

    use super::*;

    fn scene(name: &str) -> Scene {
        scenes(8).unwrap().into_iter().find(|scene| scene.name == name).unwrap()
    }

    /// Depth of 16 bits lets the sides through the labels, depth of 32 bits does not.
    #[test]
    fn labels_need_more_than_16_bits_of_depth() {
        let labels = scene("labels");
        let model = labels.true_model().unwrap();
        let truth = TrueModel::new(&model).picture(&labels.view(0), 1);
        let wrong = |depth| {
            let picture = render(&model, &View { depth, ..labels.view(0) }).unwrap();
            let pairs = picture.pixels.iter().zip(&truth.colors);
            let is_off = |shown: u8, exact: f64| (f64::from(shown) - exact).abs() > 30.0;
            pairs.filter(|(pixel, exact)| (0..3).any(|i| is_off(pixel.color[i], exact[i]))).count()
        };
        let [few, many, more] =
            [DepthFormat::U32, DepthFormat::U16, DepthFormat::Float16].map(wrong);
        assert!(few < 50 && many > 1000 && more > 1000, "{few} {many} {more}");
    }

    /// The floor fills half of the picture from its lower edge in all frames, and is five times as
    /// far at its end.
    #[test]
    fn the_floor_reaches_from_near_to_far() {
        let floor = scene("floor");
        assert!(floor.is_textured);
        let model = floor.model().unwrap();
        for frame in 0..floor.frames {
            let view = View { depth: DepthFormat::U32, ..floor.view(frame) };
            let picture = render(&model, &view).unwrap();
            let [width, _] = picture.size.map(|side| side as usize);
            let lowest = &picture.pixels[picture.pixels.len() - width..];
            assert!(lowest.iter().all(|pixel| pixel.depth > 0), "{frame}");
            let depths: Vec<_> =
                picture.pixels.iter().map(|pixel| pixel.depth).filter(|&depth| depth > 0).collect();
            let ends = [depths.iter().min().unwrap(), depths.iter().max().unwrap()];
            assert!(2 * depths.len() > picture.pixels.len(), "{frame}: {}", depths.len());
            assert!(ends[1] / ends[0] >= 5, "{frame}: {ends:?}");
        }
    }
}
