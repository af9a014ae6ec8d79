//! The way from the text of OBJ files to a model, step by step.

use std::path::Path;

use rasterizer::mesh::{Finish, Material};

use super::{
    Contents, Exact, Faces, LineFault, Model, ModelError, Options, Provenance, Report, Shape,
    TextureWrap, edges, elements, emit, faces, fit, flattening,
    indices::Indices,
    keyframes,
    libraries::{self, Pictures},
    order,
    polygons::{self, Polygons},
    quantize, quote, simplify,
    smoothing::{self, Smoothing},
    source, texture_coordinates, textures,
    triangulate::{self, Triangle},
    validate,
    vector::Vector,
    weld::{self, Welded},
    winding,
};

impl Model {
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
        let wholes = &shapes;
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
                &wholes[0],
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
            let numbers = if vertex { &tables.welded.further[..] } else { &[] };
            let faces = if face { &tables.welded.triangles[..] } else { &[] };
            Shape::new(
                positions[own.clone()].to_vec(),
                fitted.positions[own].to_vec(),
                moved_normals.of_file(number - 1, numbers),
                faces.iter().map(normal).collect(),
                faces::places(&further[number - 1], &wholes[number], &fitted),
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
