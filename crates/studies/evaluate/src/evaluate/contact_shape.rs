//! Scores of contact shapes of a ball: depth maps at its predicted places and depths, compared with depth maps at the measured places and depths.

use taceva_core::{Column, Footprint, Nanometre, counted, shown};
use taceva_dataset::Dataset;
use taceva_tasks::depth::{DepthError, DepthMap, DepthState, DepthTask};
use taceva_tasks::{TaskScores, TaskState};

use crate::error::EvaluateError;
use crate::predict::Predicted;

/// Column that names the clusters. All depths of one press are in one cluster.
const CLUSTER: &str = "point_id";
/// Channels of the place and the depth of the ball.
const PLACE: [&str; 3] = ["Px", "Py", "Pz"];

/// Presses of a ball whose contact shapes are scored.
#[derive(Clone, Copy, Debug)]
pub struct BallPresses<'a> {
    /// Row numbers of the presses in the dataset.
    pub rows: &'a [usize],
    /// Radius of the ball, in mm.
    pub radius_mm: f64,
    /// Side of a pixel of the maps, in mm.
    pub pixel_mm: f64,
    /// Sensing area; pixels outside it are invalid.
    pub footprint: Footprint,
}

/// Scores of depth maps of the ball presses `of`, as the task called `name`. `predicted` has one prediction for each of the ascending `of_rows`.
///
/// A map is the spherical cap of the ball in the plane of x and y. The constant prediction is the mean of the true maps.
///
/// # Errors
/// [`EvaluateError::Request`] for predictions without the place and depth of the ball, or without a prediction of the rows.
pub fn contact_shapes(
    dataset: &Dataset,
    name: &str,
    predicted: &Predicted,
    of_rows: &[usize],
    of: BallPresses<'_>,
) -> Result<TaskScores, EvaluateError> {
    let refused = |problem: String| EvaluateError::Request(format!("task `{name}`: {problem}"));
    let positions = PLACE.map(|channel| predicted.channels().position(channel));
    let [Some(x), Some(y), Some(z)] = positions else {
        let channels = predicted.channels().iter();
        let channels: Vec<&str> = channels.map(|channel| channel.name()).collect();
        return Err(refused(format!(
            "the model predicts {}, expected Px, Py and Pz, the place and depth of the ball",
            shown(&channels.join(", "))
        )));
    };
    let place = |columns: &[Column], at: usize| {
        let part = |position: usize| columns.get(position)?.get(at);
        Some([part(x)?, part(y)?, part(z)?])
    };
    let points = dataset.table().point_id();
    let mut shapes = Vec::new();
    for &row in of.rows {
        let at = of_rows.binary_search(&row).ok();
        let shape = at.and_then(|at| {
            Some(Shape {
                cluster: points[row].as_deref()?,
                row: row as u64 + 1,
                truth: place(predicted.truth(), at)?,
                prediction: place(predicted.prediction(), at)?,
            })
        });
        shapes.extend(shape);
    }
    if shapes.is_empty() {
        return Err(refused("no press of the ball has a prediction".to_owned()));
    }
    let state = shapes_of(&Grid::new(of), &shapes);
    let mut scored = TaskState::new(name, "depth", CLUSTER);
    scored.depth = Some(state.map_err(|error| refused(error.to_string()))?);
    scored.notes.push(format!(
        "the cap of a ball of radius {} mm at the measured and at the predicted place and depth, on pixels of {} mm; the constant is the mean of the true maps",
        of.radius_mm, of.pixel_mm
    ));
    let left_out = of.rows.len() - shapes.len();
    if left_out > 0 {
        let samples = counted(left_out, "sample");
        scored
            .notes
            .push(format!("{samples} without a prediction, left out"));
    }
    Ok(scored.scores())
}

/// Place x, y and depth of the ball in one sample, measured and predicted.
struct Shape<'a> {
    cluster: &'a str,
    /// Number of the row from 1, for messages.
    row: u64,
    truth: [f64; 3],
    prediction: [f64; 3],
}

/// Sums behind the scores of the depth maps of `shapes`.
fn shapes_of(grid: &Grid, shapes: &[Shape<'_>]) -> Result<DepthState, DepthError> {
    let [rows, columns] = grid.size();
    let mut mean = vec![0.0; rows * columns];
    for shape in shapes {
        let map = grid.cap(shape.truth)?;
        for (sum, depth) in mean.iter_mut().zip(map.mm()) {
            *sum += depth / shapes.len() as f64;
        }
    }
    let task = DepthTask::default().with_pixel_mm([grid.pixel_mm; 2])?;
    let task = task.with_constant(DepthMap::new(rows, columns, mean)?);
    let mut state = DepthState::new(task);
    for shape in shapes {
        let (truth, prediction) = (grid.cap(shape.truth)?, grid.cap(shape.prediction)?);
        state.push(shape.cluster, shape.row, &truth, &prediction)?;
    }
    Ok(state)
}

/// Pixel grid of the sensing area, with the radius of the ball.
struct Grid {
    radius_mm: f64,
    pixel_mm: f64,
    /// Centres of the columns along x, mm.
    x: Vec<f64>,
    /// Centres of the rows along y, mm.
    y: Vec<f64>,
    footprint: Footprint,
}

impl Grid {
    fn new(of: BallPresses<'_>) -> Grid {
        let [x, y] = of.footprint.half_extent().map(|half| {
            let half_mm = half.to_millimetres();
            let centres =
                std::iter::successors(Some(0.5 * of.pixel_mm), |at| Some(at + of.pixel_mm));
            let side: Vec<f64> = centres.take_while(|at| *at < half_mm).collect();
            let negative = side.iter().rev().map(|at| -at);
            negative.chain(side.iter().copied()).collect()
        });
        Grid {
            radius_mm: of.radius_mm,
            pixel_mm: of.pixel_mm,
            x,
            y,
            footprint: of.footprint,
        }
    }

    fn size(&self) -> [usize; 2] {
        [self.y.len(), self.x.len()]
    }

    /// Depth map of the ball whose lowest point is at `x`, `y` and `depth` below the surface, in mm.
    fn cap(&self, [x, y, depth]: [f64; 3]) -> Result<DepthMap, DepthError> {
        let is_inside = |x: f64, y: f64| {
            let place = [x, y].map(|side| Nanometre::from_millimetres(side).unwrap_or_default());
            self.footprint.contains(place[0], place[1])
        };
        let depth_at = |row: f64, column: f64| {
            if !is_inside(column, row) {
                return f64::NAN;
            }
            let across = (column - x) * (column - x) + (row - y) * (row - y);
            let height = self.radius_mm * self.radius_mm - across;
            match height > 0.0 {
                true => (depth - (self.radius_mm - height.sqrt())).max(0.0),
                false => 0.0,
            }
        };
        let mut mm = Vec::with_capacity(self.y.len() * self.x.len());
        for row in &self.y {
            mm.extend(self.x.iter().map(|column| depth_at(*row, *column)));
        }
        let [rows, columns] = self.size();
        DepthMap::new(rows, columns, mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        Grid::new(BallPresses {
            rows: &[],
            radius_mm: 2.0,
            pixel_mm: 0.5,
            footprint: Footprint::rectangle(2.0, 1.0, None).expect("lengths"),
        })
    }

    fn shape(prediction: [f64; 3]) -> Shape<'static> {
        Shape {
            cluster: "0.25,0.25",
            row: 1,
            truth: [0.25, 0.25, 0.5],
            prediction,
        }
    }

    /// Value of the score `metric` without a variant.
    fn score(prediction: [f64; 3], metric: &str) -> Option<f64> {
        let state = shapes_of(&grid(), &[shape(prediction)]).expect("maps");
        let scores = state.scores();
        let found = scores.iter().find(|score| score.metric == metric);
        found?.estimate.value.ok()
    }

    #[test]
    fn a_cap_is_as_deep_as_the_ball_below_it_and_zero_beside_it() {
        let map = grid().cap([0.25, 0.25, 0.5]).expect("a map");
        assert_eq!(map.size(), [4, 8]);
        // The lowest point is at the centre of a pixel.
        let depth = |column: usize| map.mm().get(2 * 8 + column).copied();
        assert_eq!(depth(4), Some(0.5));
        // 0.5 mm beside it, the ball is 2 - sqrt(4 - 0.25) mm higher.
        assert_eq!(depth(5), Some(0.5 - (2.0 - 3.75_f64.sqrt())));
        // The rim of the cap is sqrt(4 - 1.5²) = 1.32 mm from the centre.
        assert_eq!((depth(7), depth(0)), (Some(0.0), Some(0.0)));
    }

    #[test]
    fn a_perfect_predictor_has_no_error_of_depth_and_a_worse_one_has_some() {
        let truth = [0.25, 0.25, 0.5];
        for metric in ["depth_mae", "depth_rmse", "depth_max", "normal_angle"] {
            assert_eq!(score(truth, metric), Some(0.0), "{metric}");
            assert!(score([0.75, 0.25, 0.5], metric) > Some(0.0), "{metric}");
        }
        assert_eq!(score(truth, "contact_iou"), Some(1.0));
        // A deeper prediction at the same place is too deep everywhere in contact.
        let deeper = score([0.25, 0.25, 0.625], "depth_bias");
        assert!(deeper.is_some_and(|bias| bias < 0.0), "{deeper:?}");
    }

    #[test]
    fn pixels_outside_the_sensing_area_are_invalid() {
        let disc = Grid {
            footprint: Footprint::disc(2.0, None).expect("a length"),
            ..grid()
        };
        let map = disc.cap([0.0, 0.0, 0.5]).expect("a map");
        // The corner of this part of the disc is 1.9 mm from the centre, and inside.
        assert!(map.mm().iter().all(|depth| !depth.is_nan()));
        let small = Grid {
            footprint: Footprint::disc(1.5, None).expect("a length"),
            ..grid()
        };
        let map = small.cap([0.0, 0.0, 0.5]).expect("a map");
        assert!(map.mm()[0].is_nan() && !map.mm()[8 + 4].is_nan());
    }
}
