//! Figures as PDF: vectors on one page of the figure's size, with embedded glyphs.

mod code_point_box;
mod content;
mod embed;
mod face;
mod text;

use std::collections::BTreeSet;

use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

use super::Figure;
use super::canvas::Mark;
use content::{Painter, number};

/// Compression level of streams, from 0 to 10.
const COMPRESSION: u8 = 8;

/// Writes `figure` as a PDF 1.5 file. Equal figures give equal bytes, because the file has no date and no random id.
pub(super) fn write(figure: &Figure) -> Vec<u8> {
    let [catalog, pages, page, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let canvas = &figure.canvas;
    let scale = canvas
        .print
        .width_pt
        .map_or(1.0, |width| width / canvas.width);
    let mut painter = Painter::new(canvas.height, scale);
    canvas.marks.iter().for_each(|mark| painter.mark(mark));
    let drawn = painter.finish();

    let mut pdf = Pdf::new();
    pdf.set_version(1, 5);
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut written = pdf.page(page);
    let size = Rect::new(
        0.0,
        0.0,
        number(canvas.width * scale),
        number(canvas.height * scale),
    );
    written.media_box(size).parent(pages).contents(content);
    let mut resources = written.resources();
    let mut fonts = resources.fonts();
    let first_font = info.next();
    for (at, used) in (0..).zip(&drawn.fonts) {
        fonts.pair(Name(used.face.resource()), embed::font(first_font, at));
    }
    fonts.finish();
    let mut states = resources.ext_g_states();
    for hundredths in &drawn.opacities {
        let name = content::state_name(*hundredths);
        let mut state = states.insert(Name(name.as_bytes())).dict();
        state.pair(Name(b"ca"), f32::from(*hundredths) / 100.0);
    }
    states.finish();
    resources.finish();
    written.finish();
    let stream = compressed(&drawn.operators);
    pdf.stream(content, &stream).filter(Filter::FlateDecode);
    let mut about = pdf.document_info(info);
    about.title(TextStr(&figure.title));
    about.producer(TextStr("TacEva"));
    about.finish();
    for (at, used) in (0..).zip(&drawn.fonts) {
        embed::write(&mut pdf, first_font, at, used);
    }
    pdf.finish()
}

/// Letters in the labels of `figure` without a glyph. The PDF shows boxes with their code points instead.
pub(super) fn letters_without_glyph(figure: &Figure) -> BTreeSet<char> {
    let labels = figure.canvas.marks.iter().filter_map(|mark| match mark {
        Mark::Label(label) => Some(label),
        _ => None,
    });
    labels
        .flat_map(|label| label.text.chars())
        .filter(|letter| face::find(*letter, false) == face::Found::Nowhere)
        .collect()
}

/// Compresses a stream for the filter `FlateDecode`.
fn compressed(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, COMPRESSION)
}
