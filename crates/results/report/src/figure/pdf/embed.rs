//! Embeds a font: its used glyphs, their widths, and their letters for search and copy.

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use taceva_core::random::{FNV_OFFSET, fnv_1a_after};

use super::compressed;
use super::content::number;
use super::text::Used;

/// Number of PDF objects per font.
const OBJECTS: i32 = 5;
/// Identity character collection: a text contains the glyph numbers of the embedded file.
const ORDER: SystemInfo = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// Object number of the font at position `at`; `first` is the object number of the first font.
pub(super) fn font(first: Ref, at: i32) -> Ref {
    Ref::new(first.get() + at * OBJECTS)
}

/// Writes the font at position `at` among all fonts.
pub(super) fn write(pdf: &mut Pdf, first: Ref, at: i32, used: &Used) {
    let font = font(first, at);
    let [glyphs, about, file, letters] = [1, 2, 3, 4].map(|next| Ref::new(font.get() + next));
    let parsed = used.face.parsed();
    let scale = 1000.0 / f64::from(parsed.units_per_em());
    let thousandths = |units: i16| number(f64::from(units) * scale);
    let name = format!("{}+{}", tag(used), used.face.name());
    let name = Name(name.as_bytes());

    let mut whole = pdf.type0_font(font);
    whole
        .base_font(name)
        .encoding_predefined(Name(b"Identity-H"));
    whole.descendant_font(glyphs).to_unicode(letters);
    whole.finish();

    let mut cid = pdf.cid_font(glyphs);
    cid.subtype(CidFontType::Type2).base_font(name);
    cid.system_info(ORDER).font_descriptor(about);
    cid.default_width(0.0)
        .cid_to_gid_map_predefined(Name(b"Identity"));
    let widths = used.glyphs.remapped_gids().map(|glyph| {
        let advance = used.face.advance(ttf_parser::GlyphId(glyph));
        number(advance * 1000.0)
    });
    cid.widths().consecutive(0, widths);
    cid.finish();

    let mut descriptor = pdf.font_descriptor(about);
    let sides = parsed.global_bounding_box();
    let [left, low] = [sides.x_min, sides.y_min].map(thousandths);
    let [right, high] = [sides.x_max, sides.y_max].map(thousandths);
    descriptor.name(name).flags(FontFlags::SYMBOLIC);
    descriptor.bbox(Rect::new(left, low, right, high));
    descriptor.italic_angle(0.0).stem_v(used.face.stem());
    descriptor.ascent(thousandths(parsed.ascender()));
    descriptor.descent(thousandths(parsed.descender()));
    let capitals = parsed.capital_height().unwrap_or(parsed.ascender());
    descriptor.cap_height(thousandths(capitals));
    descriptor.font_file2(file);
    descriptor.finish();

    let subset = subsetter::subset(used.face.bytes(), 0, &used.glyphs)
        .expect("the fonts that are built in can be subset");
    let mut stream = compressed(&subset);
    let mut written = pdf.stream(file, &stream);
    written.filter(Filter::FlateDecode);
    written.pair(
        Name(b"Length1"),
        i32::try_from(subset.len()).unwrap_or(i32::MAX),
    );
    written.finish();

    let mut map: UnicodeCmap = UnicodeCmap::new(Name(b"Letters"), ORDER);
    for (code, letter) in &used.letters {
        map.pair(*code, *letter);
    }
    stream = compressed(map.finish().as_slice());
    let mut written = pdf.cmap(letters, &stream);
    written.filter(Filter::FlateDecode);
    written.name(Name(b"Letters")).system_info(ORDER);
}

/// Tag of a font subset: six capitals from a digest (FNV-1a) of its glyphs.
fn tag(used: &Used) -> String {
    let glyphs = used.glyphs.remapped_gids();
    let mut digest = glyphs.fold(FNV_OFFSET, |digest, glyph| {
        fnv_1a_after(digest, &glyph.to_be_bytes())
    });
    let letters = (0..6).map(|_| {
        let letter = u8::try_from(digest % 26).unwrap_or(0);
        digest /= 26;
        char::from(b'A' + letter)
    });
    letters.collect()
}

#[cfg(test)]
mod tests {
    use super::super::face::Face;
    use super::*;

    #[test]
    fn every_glyph_that_is_built_in_can_be_embedded() {
        for face in Face::ALL {
            let mut used = Used::none_of(face);
            let count = face.parsed().number_of_glyphs();
            for glyph in 0..count {
                used.glyphs.remap(glyph);
            }
            let mut pdf = Pdf::new();
            write(&mut pdf, Ref::new(1), 0, &used);
            assert!(pdf.finish().len() > 50_000, "{face:?}");
        }
    }

    #[test]
    fn another_subset_has_another_tag() {
        let tag_of = |glyphs: &[u16]| {
            let mut used = Used::none_of(Face::Regular);
            for glyph in glyphs {
                used.glyphs.remap(*glyph);
            }
            tag(&used)
        };
        assert_eq!(tag_of(&[3, 5]), tag_of(&[3, 5]));
        assert_ne!(tag_of(&[3, 5]), tag_of(&[3, 6]));
        assert!(
            tag_of(&[7])
                .bytes()
                .all(|letter| letter.is_ascii_uppercase())
        );
    }
}
