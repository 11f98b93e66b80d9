//! Tests that figures as PDF embed their fonts and lose no letter.

use std::fs;
use std::process::Command;

use crate::pdf_file::Pdf;
use crate::support::drawn;
use taceva_needs::{Need, skip};
use taceva_report::{Figure, figures};

/// Names in three scripts; no font has the last letters of the second name.
const NAMES: [&str; 2] = ["触觉 ε", "觸覺 σμ 한🖐"];

fn of_names() -> Vec<Figure> {
    figures(&NAMES.map(|name| drawn(name, 40, 1.0)))
}

#[test]
fn every_figure_embeds_its_fonts_and_compresses_its_streams() {
    let mut most = 0;
    for figure in of_names() {
        let file = figure.pdf();
        assert!(
            file == figure.pdf(),
            "{}: two files of one figure",
            figure.id
        );
        let pdf = Pdf::read(&file);
        let fonts = pdf.assert_fonts_embedded(&figure.id);
        // The page; and glyphs and letters of every font.
        assert_eq!(pdf.streams().len(), 1 + 2 * fonts, "{}", figure.id);
        most = most.max(fonts);
    }
    assert_eq!(most, 3, "regular, bold and Chinese");
}

#[test]
fn no_letter_of_a_name_is_lost() {
    let mut letters = String::new();
    let mut without_glyph = String::new();
    for figure in of_names() {
        let streams = Pdf::read(&figure.pdf()).streams();
        for stream in &streams {
            let text = String::from_utf8_lossy(stream);
            if text.contains("beginbfchar") {
                letters += &text;
            }
        }
        without_glyph.extend(figure.letters_without_glyph());
    }
    for letter in "触觉觸覺εσμ↑↓".chars() {
        let code = format!("> <{:04X}>", u32::from(letter));
        assert!(letters.to_uppercase().contains(&code), "{letter}");
    }
    assert!(without_glyph.contains('한') && without_glyph.contains('🖐'));
    assert!(without_glyph.chars().all(|letter| "한🖐".contains(letter)));
}

#[test]
fn a_reader_of_pdf_finds_the_fonts_and_the_letters() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("figure.pdf");
    let said = |program: &str, more: &[&str]| {
        let ran = Command::new(program).arg(&path).args(more).output();
        ran.map(|ran| {
            assert!(
                ran.stderr.is_empty(),
                "{}",
                String::from_utf8_lossy(&ran.stderr)
            );
            String::from_utf8_lossy(&ran.stdout).into_owned()
        })
    };
    for figure in of_names() {
        fs::write(&path, figure.pdf()).expect("written");
        let fonts = match said("pdffonts", &[]) {
            Ok(fonts) => fonts,
            Err(error) => return skip(Need::Poppler, format!("pdffonts: {error}")),
        };
        for font in fonts.lines().skip(2) {
            let words: Vec<&str> = font.split_whitespace().collect();
            // Embedded, subset, with letters; then the object number.
            let told = &words[words.len() - 5..words.len() - 2];
            assert_eq!(told, ["yes", "yes", "yes"], "{}: {fonts}", figure.id);
        }
        if figure.id == "resolution" {
            let text = said("pdftotext", &["-"]).expect("with pdffonts");
            assert!(
                text.contains("触觉 ε") && text.contains("tolerance ε"),
                "{text}"
            );
            assert!(text.contains('한') && text.contains('🖐'), "{text}");
        }
    }
}
