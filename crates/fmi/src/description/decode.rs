//! Bytes of an XML file → text: byte-order marks, UTF-8, UTF-16, ISO-8859-1.

/// The text of an XML document in whatever of the usual encodings it is.
///
/// Never fails: bytes that are no character become U+FFFD, which the XML reader then meets where it matters.
pub fn decode(bytes: &[u8]) -> String {
    match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => String::from_utf8_lossy(rest).into_owned(),
        [0xFF, 0xFE, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => utf16(rest, u16::from_be_bytes),
        // A declaration in UTF-16 without mark: '<' and a zero byte.
        [b'<', 0, ..] => utf16(bytes, u16::from_le_bytes),
        [0, b'<', ..] => utf16(bytes, u16::from_be_bytes),
        _ if is_latin1(bytes) => bytes.iter().map(|b| char::from(*b)).collect(),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&units)
}

/// Whether the declaration names a one-byte Western encoding. Windows-1252 differs from ISO-8859-1 only in typographic
/// characters, which do not occur in names.
fn is_latin1(bytes: &[u8]) -> bool {
    let declaration = bytes.split(|b| *b == b'>').next().unwrap_or_default();
    let declaration = String::from_utf8_lossy(declaration).to_ascii_lowercase();
    let names = ["iso-8859-1", "latin1", "latin-1", "windows-1252", "cp1252"];
    declaration.starts_with("<?xml") && names.iter().any(|name| declaration.contains(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_usual_encoding_gives_the_same_text() {
        let text = "<?xml version=\"1.0\"?><a b=\"Brücke\"/>";
        let marked = || std::iter::once(0xFEFF).chain(text.encode_utf16());
        let utf16 = |unit: fn(u16) -> [u8; 2]| marked().flat_map(unit).collect::<Vec<u8>>();
        assert_eq!(decode(text.as_bytes()), text);
        assert_eq!(decode(&[b"\xEF\xBB\xBF", text.as_bytes()].concat()), text);
        assert_eq!(decode(&utf16(u16::to_le_bytes)), text);
        assert_eq!(decode(&utf16(u16::to_be_bytes)), text);
        assert_eq!(decode(&utf16(u16::to_le_bytes)[2..]), text);
        let latin1 = b"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><a b=\"Br\xFCcke\"/>";
        assert!(decode(latin1).ends_with("<a b=\"Brücke\"/>"));
    }
}
