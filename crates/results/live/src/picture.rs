//! Drawings of specimens for the operator to mount.

use std::fmt::Write as _;

use taceva_core::{GratingKind, Specimen};
use taceva_protocol::Question;

/// Side of the drawing, mm.
const SIDE_MM: f64 = 24.0;

/// Drawing for a question, as SVG in mm; `None` for a question without a specimen.
pub(crate) fn of(question: &Question) -> Option<String> {
    match question {
        Question::Mount(specimen) => drawn(specimen),
        Question::Instead { of_changer, .. } => of(of_changer),
        _ => None,
    }
}

fn drawn(specimen: &Specimen) -> Option<String> {
    let shape = match specimen {
        Specimen::Sphere { radius } => sphere(radius.to_millimetres()),
        Specimen::Grating { kind, spacing } => grating(*kind, spacing.to_millimetres()),
    };
    let half = SIDE_MM / 2.0;
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {SIDE_MM} {SIDE_MM}\" role=\"img\" aria-label=\"{specimen}\">{shape}</svg>",
        -half, -half
    );
    Some(svg)
}

/// Side view of the ball on its stem over the gel, with the radius.
fn sphere(radius_mm: f64) -> String {
    let radius = radius_mm.min(0.3 * SIDE_MM);
    let gel = 0.36 * SIDE_MM;
    let centre = gel - 1.0 - radius;
    format!(
        "<rect x=\"-1\" y=\"{}\" width=\"2\" height=\"{}\" fill=\"currentColor\" opacity=\"0.45\"/>\
         <circle cx=\"0\" cy=\"{centre}\" r=\"{radius}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"0.4\"/>\
         <path d=\"M0 {centre}H{radius}\" stroke=\"currentColor\" stroke-width=\"0.25\"/>\
         <text x=\"{}\" y=\"{}\" font-size=\"1.8\" fill=\"currentColor\">{radius_mm} mm</text>\
         <rect x=\"{}\" y=\"{gel}\" width=\"{}\" height=\"2\" fill=\"currentColor\" opacity=\"0.25\"/>",
        -SIDE_MM / 2.0,
        SIDE_MM / 2.0 + centre - radius,
        radius + 0.6,
        centre + 0.6,
        -0.42 * SIDE_MM,
        0.84 * SIDE_MM
    )
}

/// Bottom view of a grating: lines along y, or dots, at their spacing and without rotation.
fn grating(kind: GratingKind, spacing_mm: f64) -> String {
    let side = 16.0_f64;
    let half = side / 2.0;
    let mut shape = format!(
        "<rect x=\"{}\" y=\"{}\" width=\"{side}\" height=\"{side}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"0.4\"/>",
        -half,
        -half - 1.5
    );
    // Finer spacings cannot be resolved on a screen.
    let step = spacing_mm.max(0.4);
    let count = ((half - 1.0) / step).floor();
    let places = std::iter::successors(Some(-count), |at| (*at < count).then_some(at + 1.0));
    // Writing to a string cannot fail.
    for across in places.clone() {
        let x = across * step;
        match kind {
            GratingKind::Line => {
                let _ = write!(
                    shape,
                    "<path d=\"M{x} {}V{}\" stroke=\"currentColor\" stroke-width=\"{}\"/>",
                    0.5 - half - 1.5,
                    half - 0.5 - 1.5,
                    0.4 * step
                );
            }
            _ => {
                for along in places.clone() {
                    let _ = write!(
                        shape,
                        "<circle cx=\"{x}\" cy=\"{}\" r=\"{}\" fill=\"currentColor\"/>",
                        along * step - 1.5,
                        0.28 * step
                    );
                }
            }
        }
    }
    let _ = write!(
        shape,
        "<text x=\"0\" y=\"{}\" font-size=\"1.8\" text-anchor=\"middle\" fill=\"currentColor\">{} grating, {spacing_mm} mm apart</text>",
        half + 1.4,
        kind.name()
    );
    shape
}

#[cfg(test)]
mod tests {
    use taceva_core::Nanometre;

    use super::*;

    #[test]
    fn what_is_mounted_is_drawn_to_scale_and_named() {
        let sphere = Question::Mount(Specimen::Sphere {
            radius: Nanometre(4_000_000),
        });
        let drawing = of(&sphere).expect("drawn");
        assert!(
            drawing.contains("r=\"4\"") && drawing.contains(">4 mm<"),
            "{drawing}"
        );
        for (kind, mark, count) in [
            (GratingKind::Line, "<path", 9),
            (GratingKind::Dot, "<circle", 81),
        ] {
            let board = Question::Mount(Specimen::Grating {
                kind,
                spacing: Nanometre(1_500_000),
            });
            let drawing = of(&board).expect("drawn");
            assert_eq!(drawing.matches(mark).count(), count, "{drawing}");
            assert!(drawing.contains("1.5 mm apart"), "{drawing}");
        }
        let instead = Question::Instead {
            of_changer: Box::new(Question::Mount(Specimen::Sphere {
                radius: Nanometre(4_000_000),
            })),
            why: "stuck".to_owned(),
        };
        assert!(of(&instead).is_some_and(|svg| svg.contains("4 mm")));
        assert_eq!(of(&Question::Unit("b".to_owned())), None);
    }
}
