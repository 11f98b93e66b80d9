//! Finds pictures of an untouched gel by their content, without regard to their labels.

use crate::evidence::Evidence;
use crate::tiles::Tiles;

/// Fraction of the greatest load up to which a picture may show an untouched gel.
const LOW: f64 = 0.1;
/// Maximum number of pictures that are tried as the centre of the densest group of similar pictures. Each is compared with at most `BESIDE` pictures.
const CANDIDATES: usize = 200;
const BESIDE: usize = 1000;
/// Minimum number of similar pictures that form a group. At least one picture in `SHARE` must belong to the group.
const LEAST: usize = 8;
const SHARE: usize = 20;
/// Radius of the group of similar pictures, as a multiple of the radius of its densest part.
const REACH: f64 = 2.5;
/// Maximum fraction of all pictures in the group of similar pictures. In a larger group, pictures do not depend on contact.
const MOST: f64 = 0.75;
/// Minimum number of separate runs of pictures in the group of similar pictures. A single held contact is not rest.
const VISITS: usize = 4;

/// Rows of the densest group of similar pictures, whose centre is a picture with a low load; empty without such a group.
///
/// Labels of force only select the candidates. After a force was zeroed again, some untouched pictures have a load but still belong to the group. A
/// picture with a depth label inside the gel does not belong to the group, even if it is similar.
pub(crate) fn look_alikes(evidence: &Evidence<'_>) -> Vec<usize> {
    let Some(load) = evidence.load() else {
        return Vec::new();
    };
    let pictures = evidence.loaded_pictures(load);
    let greatest = pictures.iter().map(|picture| picture.2).fold(0.0, f64::max);
    if pictures.len() < 2 * LEAST || greatest <= 0.0 {
        return Vec::new();
    }
    let every = |count: usize, most: usize| count.div_ceil(most).max(1);
    let low: Vec<&(usize, &Tiles, f64)> = pictures
        .iter()
        .filter(|picture| picture.2 <= LOW * greatest)
        .collect();
    let beside: Vec<&Tiles> = pictures
        .iter()
        .step_by(every(pictures.len(), BESIDE))
        .map(|picture| picture.1)
        .collect();
    let core = (beside.len() / SHARE).max(LEAST.min(beside.len() / 2));
    let radius = |centre: &Tiles| -> Option<f64> {
        let mut distances: Vec<f64> = beside.iter().map(|tiles| centre.distance(tiles)).collect();
        distances.sort_by(f64::total_cmp);
        distances.get(core).copied().filter(|far| far.is_finite())
    };
    let candidates = low.iter().step_by(every(low.len(), CANDIDATES));
    let centre = candidates
        .filter_map(|picture| Some((picture.1, radius(picture.1)?)))
        .min_by(|one, other| one.1.total_cmp(&other.1));
    let Some((centre, radius)) = centre else {
        return Vec::new();
    };
    let near = pictures
        .iter()
        .filter(|picture| centre.distance(picture.1) <= radius);
    // The mean of the core is a better picture of rest than any single one.
    let Some(rest) = Tiles::mean(near.clone().map(|picture| picture.1)) else {
        return Vec::new();
    };
    let within = near
        .map(|picture| rest.distance(picture.1))
        .fold(0.0, f64::max);
    let alike: Vec<bool> = pictures
        .iter()
        .map(|picture| rest.distance(picture.1) <= REACH * within)
        .collect();
    let without_depth = evidence.without_depth();
    let visits = alike.windows(2).filter(|pair| !pair[0] && pair[1]).count();
    let rows: Vec<usize> = pictures
        .iter()
        .zip(&alike)
        .filter(|(picture, alike)| **alike && without_depth[picture.0])
        .map(|(picture, _)| picture.0)
        .collect();
    let share = rows.len() as f64 / pictures.len() as f64;
    match rows.len() >= LEAST && share <= MOST && visits >= VISITS {
        true => rows,
        false => Vec::new(),
    }
}
