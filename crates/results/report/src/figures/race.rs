//! Chart of cost against gain. Points at the lower right have the greatest gain at the least cost.

use crate::figure::{
    Anchor, Area, Axes, Canvas, Figure, Ink, Label, Panel, Points, Scale, Stroke, beside, extent,
    short,
};
use crate::number::numeral;

/// Points with their costs and gains.
#[derive(Clone, Debug)]
pub struct Race {
    /// Title: `Summation kernels`.
    pub title: String,
    /// Conditions for the caption, such as machine, sizes and rounds.
    pub caption: String,
    /// Name of the horizontal axis, where greater is better: `right digits`.
    pub gain: String,
    /// Name of the vertical axis, where less is better: `ns a pair`. The axis is logarithmic.
    pub cost: String,
    /// Lower bound of the cost, with the name of the bound; `None` if unknown.
    pub floor: Option<(f64, String)>,
    /// Drawn points.
    pub points: Vec<RacePoint>,
}

/// One point.
#[derive(Clone, Debug)]
pub struct RacePoint {
    /// Name of the point.
    pub name: String,
    /// Gain on the horizontal axis.
    pub gain: f64,
    /// Cost; above 0.
    pub cost: f64,
    /// True if no other point has both a greater gain and a lower cost.
    pub is_on_front: bool,
}

/// Draws the points. Points on the Pareto front are filled.
pub fn race(race: &Race) -> Figure {
    let mut canvas = Canvas::new(760.0, 470.0);
    let area = Area {
        left: 62.0,
        top: 30.0,
        width: 660.0,
        height: 380.0,
    };
    let costs = race.points.iter().map(|point| point.cost);
    let floor = race.floor.iter().map(|(cost, _)| *cost);
    let costs = extent(costs.chain(floor).filter(|cost| *cost > 0.0));
    let gains = extent(race.points.iter().map(|point| point.gain).chain([0.0]));
    if let (Some([cheap, dear]), Some(gains)) = (costs, gains) {
        let panel = Panel {
            area,
            x: Scale::round(gains, area.across()),
            y: Scale::logarithmic([cheap / 1.5, dear * 1.5], area.upwards()),
        };
        let axes = Axes {
            title: String::new(),
            x: race.gain.clone(),
            y: race.cost.clone(),
        };
        panel.axes(&axes, &mut canvas);
        if let Some((cost, name)) = &race.floor {
            let y = panel.y.at(*cost);
            let stroke = Stroke {
                dash: "4 3",
                ..Stroke::thin(Ink::Muted)
            };
            canvas.line([area.left, y], [area.right(), y], stroke);
            let words = format!("floor: {} {}", short(name, 40), numeral(*cost));
            canvas.label(Label::new([area.left + 6.0, y - 5.0], words, Anchor::Start));
        }
        let mut names = Vec::new();
        for point in &race.points {
            let at = panel.at(point.gain, point.cost);
            names.push((at, short(&point.name, 40)));
            dot(point, at, &mut canvas);
        }
        for name in beside(&names, area) {
            canvas.label(name);
        }
    }
    let front = race.points.iter().filter(|point| point.is_on_front);
    let front: Vec<String> = front.map(|point| point.name.clone()).collect();
    Figure {
        id: "race".to_owned(),
        title: race.title.clone(),
        caption: format!("{} Filled: on the Pareto front.", race.caption),
        description: format!(
            "{}. On the Pareto front: {}.",
            race.caption,
            crate::names::listed(&front)
        ),
        canvas,
    }
}

fn dot(point: &RacePoint, at: [f64; 2], canvas: &mut Canvas) {
    let words = format!(
        "{}: {} at {}",
        point.name,
        numeral(point.gain),
        numeral(point.cost)
    );
    let one = |words: Vec<String>| Points {
        at: vec![at],
        words,
    };
    canvas.points(one(vec![words]), Ink::Series(0), 5.5, 1.0);
    if !point.is_on_front {
        canvas.points(one(Vec::new()), Ink::Paper, 3.9, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cheaper_stands_lower_and_the_better_to_the_right() {
        let point = |name: &str, gain, cost| RacePoint {
            name: name.to_owned(),
            gain,
            cost,
            is_on_front: name == "fast",
        };
        let drawn = race(&Race {
            title: "drawn".to_owned(),
            caption: "Drawn.".to_owned(),
            gain: "digits".to_owned(),
            cost: "ns".to_owned(),
            floor: Some((0.5, "reading".to_owned())),
            points: vec![point("fast", 8.0, 1.0), point("right", 17.0, 30.0)],
        });
        let svg = drawn.svg();
        let place = |name: &str| {
            let (before, _) = svg.split_once(&format!("<title>{name}:")).expect("drawn");
            let circle = before.rsplit("<circle ").next().expect("a circle");
            let number = |key: &str| -> f64 {
                let (_, rest) = circle.split_once(&format!("{key}=\"")).expect("there");
                rest.split('"')
                    .next()
                    .expect("quoted")
                    .parse()
                    .expect("a number")
            };
            [number("cx"), number("cy")]
        };
        let [fast, right] = ["fast", "right"].map(place);
        assert!(fast[0] < right[0] && fast[1] > right[1]);
    }
}
