//! From an OBJ file to const tables.
//!
//! [`Model::load`] checks the file line by line, cuts its polygons into triangles, computes the
//! normals it lacks, merges equal vertices, fits and quantises them, and orders the triangles for
//! vertex reuse. [`emit::source`] writes the result as Rust, [`blob::bytes`] as a binary file;
//! [`convert_for_build`] does all of it from a build script; [`Model::mesh`] gives the same tables
//! at run time. [`Exact`] keeps their values before rounding. With [`Options::simplify`] fewer
//! triangles are left. [`Model::load_keyframes`] converts several files, the shapes of one model.
//!
//! The converter reads positions, normals, texture coordinates, faces, lines, points, diffuse
//! colours, textures and finishes of an OBJ file, the colours of its vertices (`v x y z r g b`),
//! and its smoothing groups where it has no normals. What else a file shows and the tables cannot
//! hold, such as curves and textures of opacity, it leaves out with a warning for each kind.

pub mod blob;
mod cap;
mod ears;
mod edges;
mod elements;
pub mod emit;
mod emit_keyframes;
mod emit_lines;
mod emit_textures;
mod error;
mod faces;
mod fit;
mod flattening;
mod ignored;
mod indices;
mod keyframes;
mod libraries;
mod library_path;
mod measure;
mod mtl;
mod normals;
mod options;
mod order;
mod polygons;
mod provenance;
mod quantize;
mod quote;
mod report;
mod simplify;
mod slivers;
mod smoothing;
mod source;
#[cfg(test)]
mod tests;
mod texture_coordinates;
mod texture_map;
mod textures;
mod topology;
mod triangulate;
mod validate;
mod vector;
mod vertex_colors;
mod warnings;
mod weld;
mod winding;
mod write;

use std::path::{Path, PathBuf};

use rasterizer::{
    mesh::{Finish, Keyframe, Material, Mesh, Normals, Positions, Tables},
    numbers::{Scale, Vec3},
};

pub use error::{Difference, LineFault, ModelError};
pub use faces::{Face, Faces};
pub use indices::Indices;
pub use keyframes::Shape;
pub use options::{Contents, Fit, Options};
pub use provenance::Provenance;
pub use quote::printable;
pub use report::{Flash, Report, Simplification, thousands};
pub use texture_coordinates::TextureTable;
pub use textures::{
    AlphaFormat, ColorFormat, Picture, TexelFormat, Texture, TextureOptions, TextureWrap, Textures,
    choose_palette,
};
pub use write::{convert_for_build, write_atomically};

use libraries::Pictures;
use polygons::Polygons;
use smoothing::Smoothing;
use triangulate::Triangle;
use vector::Vector;
use weld::Welded;

/// A converted model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The name of the static, in capitals.
    pub name: String,
    /// How it is converted. The contents are those that it has.
    pub options: Options,
    /// The files it is made from: the OBJ, its material libraries, and pictures.
    pub provenance: Vec<Provenance>,
    /// The paths of these, and of libraries that cannot be read.
    pub inputs: Vec<PathBuf>,
    /// Positions in quanta.
    pub positions: Vec<[i16; 3]>,
    /// The length of a quantum in model units.
    pub scale: Scale,
    /// Where position (0, 0, 0) lies, in model units.
    pub offset: Vec3,
    /// Unit normals of the vertices in 127ths, or none.
    pub vertex_normals: Vec<[i8; 3]>,
    /// Unit normals of the triangles in 127ths, or none.
    pub face_normals: Vec<[i8; 3]>,
    /// Texture coordinates of the vertices, or none.
    pub texture_coordinates: TextureTable,
    /// Colours of the vertices, or none.
    pub vertex_colors: Vec<[u8; 3]>,
    /// Vertex indices, sorted by material.
    pub triangles: Indices,
    /// The edges as lines between vertices, if they are made.
    pub edges: Vec<[u32; 2]>,
    /// The lines of the file (`l`) between vertices, for each material; none if it has none.
    pub lines: Vec<Vec<[u32; 2]>>,
    /// The vertices that are points of the file (`p`), for each material; none if it has none.
    pub points: Vec<Vec<u32>>,
    /// The colours and how many triangles each covers.
    pub materials: Vec<Material>,
    /// What the materials show besides, or none if all are matte and opaque.
    pub finishes: Vec<Finish>,
    /// The textures of the materials, if any of them has one.
    pub textures: Option<Textures>,
    /// Further shapes of the model, each of another file.
    pub keyframes: Vec<Shape>,
    /// The tables before rounding.
    pub exact: Exact,
    /// What the conversion changes.
    pub report: Report,
    /// What the conversion ignores.
    pub warnings: Vec<String>,
}

/// The values of the tables before rounding, in the same order and units. A table that is left out
/// is empty here too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exact {
    /// Positions in model units.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals of the vertices.
    pub vertex_normals: Vec<[f64; 3]>,
    /// Unit normals of the triangles.
    pub face_normals: Vec<[f64; 3]>,
    /// Texture coordinates in repeats of the texture, v running down. Where textures repeat, they
    /// may be moved by whole repeats.
    pub texture_coordinates: Vec<[f64; 2]>,
    /// The faces of the file, not yet cut into triangles.
    pub faces: Faces,
}

impl Model {
    /// Converts the OBJ file at `path`.
    ///
    /// # Errors
    ///
    /// Returns an error if the file cannot be read, a line of it is wrong, or the model does not
    /// fit the tables. Each error names the file, the line if there is one, and what to do. Faults
    /// of material libraries are only [warnings](Self::warnings).
    pub fn load(path: impl AsRef<Path>, options: &Options) -> Result<Self, ModelError> {
        let path = path.as_ref();
        Self::from_bytes(path, &source::read(path)?, options)
    }

    /// Converts the contents of an OBJ file. Its material libraries lie beside `path`, which names
    /// it in messages.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::load`], except those of reading the file.
    pub fn from_bytes(path: &Path, bytes: &[u8], options: &Options) -> Result<Self, ModelError> {
        Self::keyframes_from_bytes((path, bytes), &[], options)
    }

    /// Converts OBJ files of one model in several shapes: the first one, and as its
    /// [keyframes](Self::keyframes) what vertices and normals are in the others. Faces, texture
    /// coordinates and materials are the same in all of them; colours, textures and what else they
    /// show is that of the first one. All have one scale and one offset.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::load`] for each of the files, and
    /// [`Topology`](ModelError::Topology) for the first difference between two of them.
    pub fn load_keyframes(
        first: impl AsRef<Path>,
        further: &[PathBuf],
        options: &Options,
    ) -> Result<Self, ModelError> {
        let path = first.as_ref();
        let bytes = source::read(path)?;
        let further: Vec<(&Path, Vec<u8>)> = further
            .iter()
            .map(|path| Ok((path.as_path(), source::read(path)?)))
            .collect::<Result<_, ModelError>>()?;
        let further: Vec<_> = further.iter().map(|(path, bytes)| (*path, &bytes[..])).collect();
        Self::keyframes_from_bytes((path, &bytes), &further, options)
    }

    /// Converts the contents of OBJ files as [`load_keyframes`](Self::load_keyframes) does. Each
    /// has the path that names it in messages.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::load_keyframes`], except those of reading the files.
    pub fn keyframes_from_bytes(
        (path, bytes): (&Path, &[u8]),
        others: &[(&Path, &[u8])],
        options: &Options,
    ) -> Result<Self, ModelError> {
        let degrees = options.crease_degrees;
        if !(0.0..=180.0).contains(&degrees) {
            return Err(ModelError::Crease { degrees });
        }
        if let Some(degrees) = options.edges_degrees.filter(|d| !(0.0..=180.0).contains(d)) {
            return Err(ModelError::Edges { degrees });
        }
        if bytes.is_empty() {
            return Err(ModelError::Empty { path: path.into() });
        }
        let statements = source::statements(source::text(path, bytes)?);
        let mut checked = validate::check(path, &statements, options.contents)?;
        let pictures = match options.textures {
            None => Pictures::LeftOut,
            Some(_) if checked.textured_corners == 0 => Pictures::Unplaced,
            Some(_) => Pictures::Kept,
        };
        let mut libraries = libraries::load(path, &checked, options.contents, pictures);
        let mut polygons = polygons::read(path, &checked, &libraries)?;
        if options.simplify.is_some() && !others.is_empty() {
            return Err(ModelError::SimplifiedKeyframes);
        }
        let first = (path, &checked, &mut polygons);
        let mut further = keyframes::read(first, others, &libraries, options.contents)?;
        if options.simplify.is_none() {
            at_most_16_bits(path, polygons.positions.len())?;
        }

        let mut shapes = keyframes::shapes(&polygons, &further);
        if fit::has_no_size(&shapes.concat()) {
            return Err(ModelError::NoSize { path: path.into() });
        }
        let winding = winding::judge(&polygons, &shapes[0]);
        if options.fix_winding {
            let all = std::iter::once(&mut polygons).chain(&mut further);
            all.zip(&shapes).for_each(|(polygons, shape)| winding.mend(polygons, shape));
        }
        checked.warnings.extend(winding.warning(path, options.fix_winding));
        let (mut corners, dropped_triangles) = triangulate::triangulate(&polygons, &shapes);
        let normals = |corners: &mut [Triangle], shape: &[Vector]| {
            if !options.smoothing_groups {
                corners.iter_mut().for_each(|triangle| triangle.smoothing = Smoothing::Unstated);
            }
            if options.contents.vertex_normals {
                smoothing::corner_normals(corners, shape, degrees.to_radians())
            } else {
                Vec::new()
            }
        };
        let follows_groups = options.smoothing_groups
            && options.contents.vertex_normals
            && smoothing::matters(&corners);
        let (mut frame, mut simplification) = (None, None);
        if let Some(most) = options.simplify {
            let shape = &mut shapes[0];
            let is_textured = pictures == Pictures::Kept || options.contents.texture_coordinates;
            let found = simplify::simplify(
                path,
                (&polygons, shape),
                (&corners, &normals(&mut corners.clone(), shape)),
                (options.contents, is_textured),
                most,
            )?;
            if let Some(simplified) = found {
                frame = Some(used(&polygons, &corners, shape));
                checked.face_lines =
                    simplify::lines_of(&polygons, &checked.face_lines, &simplified);
                *shape = simplified.kept.iter().map(|&i| shape[i as usize]).collect();
                polygons = simplified.polygons;
                simplification = Some(simplified.report);
                checked.warnings.extend(simplified.warning);
                (corners, _) = triangulate::triangulate(&polygons, &shapes);
            }
            at_most_16_bits(path, polygons.positions.len())?;
        }
        // The largest of what is no longer needed: of a million triangles 200 MB.
        let all = std::mem::take(&mut polygons.corners);
        let file_textures = faces::texture_coordinates(&all, checked.textured_corners);
        let colors: Vec<u32> =
            if options.contents.vertex_colors && !polygons.vertex_colors.is_empty() {
                all.iter().map(|corner| corner.color).collect()
            } else {
                Vec::new()
            };
        let rings = all.into_iter().map(|corner| corner.position).collect();
        checked.text = String::new();
        let has_elements = !(polygons.lines.is_empty() && polygons.points.is_empty());
        if corners.is_empty() && !has_elements {
            return Err(ModelError::NoArea { path: path.into(), faces: checked.faces });
        }
        let (used, ranks) = sort_by_material(&mut corners, &polygons);
        let mut moved: Vec<Vec<Triangle>> = further
            .iter()
            .map(|polygons| {
                let (mut corners, _) = triangulate::triangulate(polygons, &shapes);
                corners.sort_by_key(|triangle| ranks[triangle.material]);
                corners
            })
            .collect();
        let loaded = match options.textures.filter(|_| pictures == Pictures::Kept) {
            None => None,
            Some(textures) => {
                // Lines and points have no textures.
                let wanted = |&(id, count)| libraries.wanted(id).filter(|_| count > 0);
                let wanted: Vec<_> = used.iter().map(wanted).collect();
                textures::load(path, &wanted, &textures, &mut checked.warnings)?
            }
        };
        let mut options = options.clone();
        if let Some(loaded) = &loaded {
            if let Some((line, word)) = checked.broken_texture {
                let fault = LineFault::NotFinite { word };
                return Err(ModelError::Line { path: path.into(), line, fault });
            }
            options.contents.texture_coordinates = true;
            for (&(id, _), mean) in used.iter().zip(&loaded.means) {
                let takes_mean = |m: &libraries::Material| m.takes_mean;
                if libraries.materials.get(id).is_some_and(takes_mean) {
                    polygons.colors[id] = mean.unwrap_or(polygons.colors[id]);
                }
            }
        }
        let materials: Vec<Material> =
            used.iter().map(|&(id, count)| Material::new(polygons.colors[id], count)).collect();
        let finishes: Vec<Finish> = used.iter().map(|&(id, _)| libraries.finish(id)).collect();
        let is_matte = finishes.iter().all(|&finish| finish == Finish::MATTE);
        let finishes = if is_matte { Vec::new() } else { finishes };
        let moved_normals: Vec<_> = if options.contents.vertex_normals {
            moved.iter_mut().zip(&shapes[1..]).map(|(moved, shape)| normals(moved, shape)).collect()
        } else {
            Vec::new()
        };
        let moved_normals = keyframes::CornerNormals::new(&moved_normals);
        let normals = normals(&mut corners, &shapes[0]);
        let numbers = &moved_normals.numbers;
        let welded = weld::weld(&corners, &normals, numbers, &polygons, options.contents);

        let mut tables = order::Ordered::new(welded, &materials);
        let elements = elements::place(&polygons, &ranks, materials.len(), &mut tables.welded);
        at_most_16_bits(path, tables.welded.positions.len())?;
        let (lines, points) = (elements.line_count(), elements.point_count());
        let at = |positions: &[Vector]| -> Vec<Vector> {
            tables.welded.positions.iter().map(|&p| positions[p as usize]).collect()
        };
        let whole = &shapes[0];
        let shapes: Vec<Vector> = shapes.iter().flat_map(|shape| at(shape)).collect();
        let original: Vec<Vector> = (std::iter::once(&polygons).chain(&further))
            .flat_map(|polygons| at(&polygons.positions))
            .collect();
        let frame = frame.as_ref().unwrap_or(&shapes);
        let mut fitted = fit::fit(path, &original, &shapes, frame, options.fit)?;
        // Vertices of a shape. Those of all shapes follow each other.
        let count = tables.welded.positions.len();
        let faces = Faces {
            texture_coordinates: file_textures,
            vertex_colors: faces::vertex_colors(&polygons, &colors),
            ..Faces::new(
                &polygons,
                &ranks,
                rings,
                whole,
                &fitted,
                &checked.face_lines,
                &tables.welded.positions,
            )
        };
        let (mut positions, scale) =
            quantize::positions(&fitted.positions, fit::offset_units(fitted.offset));
        let keyframes = (1..=others.len()).map(|number| {
            let own = number * count..(number + 1) * count;
            let (vertex, face) = (options.contents.vertex_normals, options.contents.face_normals);
            let first = shapes.chunks(count).skip(number).chain(shapes.chunks(count));
            let normal = |triangle| keyframes::normal_of_face(first.clone(), triangle);
            let further = if vertex { &tables.welded.further[..] } else { &[] };
            let faces = if face { &tables.welded.triangles[..] } else { &[] };
            Shape::new(
                positions[own.clone()].to_vec(),
                fitted.positions[own].to_vec(),
                moved_normals.of_file(number - 1, further),
                faces.iter().map(normal).collect(),
            )
        });
        let keyframes: Vec<Shape> = keyframes.collect();
        positions.truncate(count);
        fitted.positions.truncate(count);
        let (original, shape) = (&original[..count], &shapes[..count]);
        let rounding = flattening::Rounding {
            written: &polygons.positions,
            original,
            shape,
            rounded: &positions,
        };
        let triangles = &tables.welded.triangles;
        checked.warnings.extend(flattening::warning(path, &statements, triangles, rounding));
        let mut exact = Exact {
            faces,
            ..exact(path, options.contents, &checked, fitted.positions, &shapes, &tables.welded)?
        };
        let textures = loaded.as_ref().map(|loaded| &loaded.textures);
        let repeats = textures.is_none_or(|textures| textures.wrap[0] == TextureWrap::Repeat);
        let texture_coordinates;
        (texture_coordinates, exact.texture_coordinates) =
            texture_coordinates::quantized(path, exact.texture_coordinates, triangles, repeats)?;
        let some_without = checked.textured_corners < checked.corners;
        if options.contents.texture_coordinates && some_without {
            checked.warnings.push(format!(
                "{}: {} of {} face corners have no texture coordinates and get (0, 0)",
                quote::shown(path),
                checked.corners - checked.textured_corners,
                checked.corners
            ));
        }

        let (textures, files) = loaded.map_or((None, Vec::new()), |l| (Some(l.textures), l.files));
        let pictures = (textures.iter().flat_map(|textures| &textures.textures))
            .map(|texture| texture.path.clone())
            .collect();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut model = Self {
            name: emit::static_name(options.name.as_deref().unwrap_or(&stem)),
            provenance: [
                vec![Provenance::of(path, bytes)],
                others.iter().map(|(path, bytes)| Provenance::of(path, bytes)).collect(),
                libraries.files,
                files,
            ]
            .concat(),
            inputs: [
                vec![path.into()],
                others.iter().map(|&(path, _)| path.into()).collect(),
                libraries.paths,
                pictures,
            ]
            .concat(),
            vertex_normals: exact.vertex_normals.iter().map(|&n| quantize::normal(n)).collect(),
            face_normals: exact.face_normals.iter().map(|&n| quantize::normal(n)).collect(),
            triangles: Indices::new(&tables.welded.triangles, positions.len()),
            edges: (options.edges_degrees)
                .map_or_else(Vec::new, |degrees| edges::edges(&exact.faces, degrees)),
            lines: elements.lines,
            points: elements.points,
            positions,
            scale,
            offset: fitted.offset,
            texture_coordinates,
            vertex_colors: tables.welded.colors,
            materials,
            finishes,
            textures,
            keyframes,
            exact,
            report: Report {
                file_vertices: checked.vertices,
                file_faces: checked.faces,
                triangles: tables.welded.triangles.len(),
                lines,
                points,
                dropped_triangles,
                turned_faces: if options.fix_winding { winding.turned() } else { 0 },
                simplification,
                smoothing_groups: follows_groups,
                cache_misses_before: tables.cache_misses_before,
                cache_misses: tables.cache_misses,
                ..Report::default()
            },
            options,
            warnings: checked.warnings,
        };
        model.warnings.append(&mut libraries.warnings);
        model.measure();
        Ok(model)
    }

    /// Returns the tables as a mesh that can be drawn.
    ///
    /// # Panics
    ///
    /// Panics if the fields have been changed and are no valid mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh::new_const(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            offset: self.offset,
            vertex_normals: Normals::I8(&self.vertex_normals),
            face_normals: Normals::I8(&self.face_normals),
            texture_coordinates: self.texture_coordinates.as_column(),
            vertex_colors: &self.vertex_colors,
            triangles: self.triangles.as_triangles(),
            materials: &self.materials,
            finishes: &self.finishes,
        })
    }

    /// Returns its further shapes, for [`Keyframes::new`](rasterizer::mesh::Keyframes::new).
    #[must_use]
    pub fn further_shapes(&self) -> Vec<Keyframe<'_>> {
        self.keyframes.iter().map(Shape::keyframe).collect()
    }
}

fn at_most_16_bits(path: &Path, count: usize) -> Result<(), ModelError> {
    if count <= 1 << 16 {
        Ok(())
    } else {
        Err(ModelError::TooManyVertices { path: path.into(), count })
    }
}

/// The places of all corners of triangles, and of the ends of lines and points.
fn used(polygons: &Polygons, triangles: &[Triangle], shape: &[Vector]) -> Vec<Vector> {
    let corners = triangles.iter().flat_map(|triangle| triangle.corners).map(|c| c.position);
    let lines = polygons.lines.iter().flat_map(|line| line.vertices).map(|end| end.position);
    let points = polygons.points.iter().flat_map(|point| point.vertices).map(|end| end.position);
    corners.chain(lines).chain(points).map(|position| shape[position as usize]).collect()
}

/// Sorts triangles by material, in the order in which materials are first used, and those of lines
/// and points alone last. Lists the materials used, with the number of triangles of each, and for
/// each of all its place in that list.
fn sort_by_material(
    triangles: &mut [Triangle],
    polygons: &Polygons,
) -> (Vec<(usize, u32)>, Vec<Option<usize>>) {
    let mut used: Vec<(usize, u32)> = Vec::new();
    let mut ranks = vec![None; polygons.colors.len()];
    let mut rank = |material: usize, triangles| {
        let rank = *ranks[material].get_or_insert_with(|| {
            used.push((material, 0));
            used.len() - 1
        });
        used[rank].1 += triangles;
    };
    triangles.iter().for_each(|triangle| rank(triangle.material, 1));
    polygons.lines.iter().for_each(|line| rank(line.material, 0));
    polygons.points.iter().for_each(|point| rank(point.material, 0));
    triangles.sort_by_key(|triangle| ranks[triangle.material]);
    (used, ranks)
}

/// The unrounded tables that `contents` asks for.
fn exact(
    path: &Path,
    contents: Contents,
    checked: &validate::Checked,
    positions: Vec<Vector>,
    shapes: &[Vector],
    welded: &Welded,
) -> Result<Exact, ModelError> {
    if contents.texture_coordinates && checked.textured_corners == 0 {
        return Err(ModelError::NoTextureCoordinates { path: path.into() });
    }
    let face_normal = |t: &[u32; 3]| keyframes::normal_of_face(shapes.chunks(positions.len()), t);
    Ok(Exact {
        vertex_normals: if contents.vertex_normals { welded.normals.clone() } else { Vec::new() },
        face_normals: if contents.face_normals {
            welded.triangles.iter().map(face_normal).collect()
        } else {
            Vec::new()
        },
        texture_coordinates: if contents.texture_coordinates {
            welded.textures.iter().map(|&t| texture_coordinates::turned(t)).collect()
        } else {
            Vec::new()
        },
        positions,
        ..Exact::default()
    })
}
