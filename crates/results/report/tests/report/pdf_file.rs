//! Reads PDF files without a library, which might share errors with the writer.

/// Objects of a file, in order, each from its number to `endobj`.
pub(crate) struct Pdf(Vec<Vec<u8>>);

impl Pdf {
    /// Reads `file`. Fails if its cross-reference table does not match its objects.
    pub(crate) fn read(file: &[u8]) -> Pdf {
        assert!(file.starts_with(b"%PDF-1.5"), "the version");
        let end = String::from_utf8_lossy(&file[file.len() - 40..]).into_owned();
        let begin = end.lines().rev().nth(1).and_then(|line| line.parse().ok());
        let begin: usize = begin.expect("where the table is");
        let table = String::from_utf8_lossy(&file[begin..]).into_owned();
        assert!(table.starts_with("xref\n"), "{table}");
        let places = table.lines().filter_map(|line| {
            let place = line.trim_end().strip_suffix(" 00000 n")?;
            place.parse::<usize>().ok()
        });
        let objects = places.enumerate().map(|(at, place)| {
            let rest = &file[place..];
            assert!(rest.starts_with(format!("{} 0 obj", at + 1).as_bytes()));
            let length = position(rest, b"endobj").expect("an end");
            rest[..length].to_vec()
        });
        Pdf(objects.collect())
    }

    /// Object dictionaries, without their streams.
    pub(crate) fn dictionaries(&self) -> Vec<String> {
        let heads = self.0.iter().map(|object| {
            let end = position(object, b"stream\n").unwrap_or(object.len());
            String::from_utf8_lossy(&object[..end]).into_owned()
        });
        heads.collect()
    }

    /// Decompressed streams. Fails if one is not compressed.
    pub(crate) fn streams(&self) -> Vec<Vec<u8>> {
        let mut streams = Vec::new();
        for object in &self.0 {
            let Some(begin) = position(object, b"stream\n") else {
                continue;
            };
            let head = String::from_utf8_lossy(&object[..begin]);
            assert!(head.contains("/Filter /FlateDecode"), "{head}");
            let stream = &object[begin + b"stream\n".len()..];
            let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(stream);
            // The decoder ignores `endstream` after the compressed data.
            streams.push(bytes.expect("a whole stream"));
        }
        streams
    }

    /// Fails unless every font is an embedded subset with the letters of its glyphs.
    pub(crate) fn assert_fonts_embedded(&self, name: &str) -> usize {
        let heads = self.dictionaries();
        let counted = |word: &str| heads.iter().filter(|head| head.contains(word)).count();
        let fonts = counted("/Subtype /Type0");
        assert!(fonts > 0, "{name}: no font");
        for word in [
            "/Subtype /CIDFontType2",
            "/FontFile2 ",
            "/ToUnicode ",
            "/Length1 ",
        ] {
            assert_eq!(counted(word), fonts, "{name}: {word}");
        }
        for standard in ["/Subtype /Type1", "/Subtype /TrueType", "Helvetica"] {
            assert_eq!(counted(standard), 0, "{name}: {standard}");
        }
        for head in heads.iter().filter(|head| head.contains("/BaseFont")) {
            let (_, font) = head.split_once("/BaseFont /").expect("a name");
            let (tag, _) = font.split_once('+').expect("the tag of a subset");
            assert!(tag.len() == 6 && tag.bytes().all(|letter| letter.is_ascii_uppercase()));
        }
        fonts
    }
}

/// Offset of the first occurrence of `needle`.
fn position(bytes: &[u8], needle: &[u8]) -> Option<usize> {
    bytes
        .windows(needle.len())
        .position(|window| window == needle)
}
