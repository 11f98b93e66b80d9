//! Lines of `[frame]` for pictures in cells, arrays and clips of a table.

use super::{Beside, FrameLines, of_sides, of_views};
use crate::draft::tables::SeenTable;
use crate::draft::views::features;
use crate::foreign::{PictureColumn, PictureKind};

/// Lines of `[frame]` for the pictures in `main` itself, one entry for each view.
pub(super) fn in_table(main: &SeenTable<'_>) -> Vec<FrameLines> {
    let Some((first, others)) = main.pictures.split_first() else {
        return Vec::new();
    };
    let names: Vec<&str> = main.pictures.iter().map(|own| own.name.as_str()).collect();
    let lines = |at: usize| in_array(&main.pictures[at], None, &[]);
    let mut views = of_views(&names, lines);
    // Cameras of LeRobot have names of their own. A depth map is not a further view.
    if views.is_empty() && main.is_lerobot() {
        let is_depth = |at: &usize| matches!(main.pictures[*at].kind, PictureKind::Depth(_));
        let cameras = (0..names.len()).filter(|at| !is_depth(at));
        views = of_sides(features(cameras.map(|at| (at, names[at]))), lines);
    }
    let is_of = |name: &str| {
        let written = format!("{name:?}");
        let mut lines = views.iter().flat_map(|view| &view.lines);
        lines.any(|line| line.contains(&written))
    };
    let others_of_row: Vec<&str> = names.iter().copied().filter(|name| !is_of(name)).collect();
    match views.first_mut() {
        None => vec![in_array(first, None, others)],
        Some(first) => {
            if !others_of_row.is_empty() {
                let others = format!("# Other pictures of a row: {}", others_of_row.join(", "));
                first.lines.insert(0, others);
            }
            views
        }
    }
}

/// Lines of `[frame]` for `picture`. A comment lists `others`: further picture arrays of the same table.
pub(super) fn in_array(
    picture: &PictureColumn,
    beside: Option<Beside>,
    others: &[PictureColumn],
) -> FrameLines {
    let name = &picture.name;
    let mut lines: Vec<String> = match others {
        [] => Vec::new(),
        others => {
            let others: Vec<&str> = others.iter().map(|other| other.name.as_str()).collect();
            vec![format!("# or: {}", others.join(", "))]
        }
    };
    let mut is_gray = false;
    match (&picture.kind, beside) {
        (PictureKind::Clip, _) => lines.push(format!("video = {name:?}")),
        (PictureKind::Depth(codes), _) => {
            is_gray = true;
            let [least, greatest] = codes.ends_mm();
            lines.push(format!("video = {name:?}   # a depth map: distances from {least} mm to {greatest} mm, in whole millimetres"));
            if codes.is_finer_than_millimetres() || greatest > 65_535.0 {
                lines.push(format!("range = [{least}, {greatest}]   # mm: its codes are finer than 1 mm or exceed 16 bits"));
                lines.push("bits = 16".to_owned());
            }
        }
        (PictureKind::Encoded, _) => lines.push(format!("bytes = {name:?}")),
        (PictureKind::Array { .. }, None) => lines.push(format!("array = {name:?}")),
        (PictureKind::Array { .. }, Some(beside)) => {
            lines.extend(beside.comment);
            lines.push(format!("array = {{ file = {:?} }}", beside.file));
            lines.extend(beside.index);
        }
    }
    if let PictureKind::Array {
        is_gray: gray,
        is_planar,
        range,
    } = &picture.kind
    {
        is_gray = *gray;
        if *is_planar {
            lines.push("layout = \"nchw\"".to_owned());
        }
        if let Some([least, greatest]) = range {
            let (black, full) = guessed_range(*least, *greatest);
            lines.push(format!("# The first frames have numbers from {least} to {greatest}: which is black, which is full?"));
            lines.push(format!("range = [{black}, {full}]"));
            lines.push("bits = 8".to_owned());
        }
    }
    FrameLines {
        lines,
        is_gray,
        order: picture.order,
        ..FrameLines::default()
    }
}

/// Values of black and of full scale for pictures with values from `least` to `greatest`: 0 and 1, −1 and 1, 0 and 255, or else the extremes.
fn guessed_range(least: f64, greatest: f64) -> (f64, f64) {
    match (least, greatest) {
        (least, greatest) if least >= 0.0 && greatest <= 1.0 => (0.0, 1.0),
        (least, greatest) if least >= -1.0 && greatest <= 1.0 => (-1.0, 1.0),
        (least, greatest) if least >= 0.0 && greatest <= 255.0 => (0.0, 255.0),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_guessed_by_what_pictures_are_mostly_kept_in() {
        assert_eq!(guessed_range(0.1, 0.9), (0.0, 1.0));
        assert_eq!(guessed_range(-0.5, 0.9), (-1.0, 1.0));
        assert_eq!(guessed_range(3.0, 250.0), (0.0, 255.0));
        assert_eq!(guessed_range(-2048.0, 2032.0), (-2048.0, 2032.0));
    }
}
