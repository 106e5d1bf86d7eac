//! Files that are known by name and not read, each with the way out.

/// Bytes of a file's beginning that are looked at.
pub(super) const HEAD: u64 = 4096;

/// What a file is by its first bytes, and what to do; `None` if it may be text of a format that is read.
pub(super) fn recognise(head: &[u8]) -> Option<&'static str> {
    let begins = |magic: &[u8]| head.starts_with(magic);
    if begins(&[0xff, 0xfe]) || begins(&[0xfe, 0xff]) {
        return Some("a text of UTF-16: save it as UTF-8");
    }
    if begins(b"PK\x03\x04") {
        return Some("a ZIP archive, perhaps .npz or .xlsx: write the matrix with scipy.io.mmwrite");
    }
    if begins(b"\x93NUMPY") {
        return Some("an array of NumPy: write it with scipy.io.mmwrite");
    }
    if begins(b"\x89HDF") {
        return Some("HDF5, perhaps .mat of version 7.3: write the matrix with scipy.io.mmwrite");
    }
    if begins(b"MATLAB 5.0") {
        return Some("a MAT-file of Matlab: read it with scipy.io.loadmat and write it with scipy.io.mmwrite");
    }
    if begins(b"\x1f\x8b") {
        return Some("compressed by gzip: unpack it");
    }
    // A record of Fortran with the header of OUTPUT4: 24 bytes, or 48 with 64-bit words.
    let word = |at: usize| head.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
    let record =
        |bytes: [u8; 4]| matches!(i32::from_le_bytes(bytes), 24 | 48) || matches!(i32::from_be_bytes(bytes), 24 | 48);
    if word(0).is_some_and(record) && head.contains(&0) {
        return Some(
            "binary OUTPUT4 of Nastran: read it with pyNastran or pyYeti and write it with scipy.io.mmwrite \
             (docs/guide/import.md, Nastran)",
        );
    }
    if head.contains(&0) {
        return Some(
            "a binary file: write text (ANSYS .full: /AUX2 and HBMAT; Nastran: DMIG in wide fields; Python: \
             scipy.io.mmwrite; docs/guide/import.md)",
        );
    }
    let first = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    if output4(first) {
        return Some(
            "OUTPUT4 of Nastran: read it with pyNastran or pyYeti and write it with scipy.io.mmwrite \
             (docs/guide/import.md, Nastran)",
        );
    }
    None
}

/// Header of OUTPUT4 in ASCII: columns, rows, form, type in fields of 8 or 16, then name and format: `2KAA     1P,3E23.16`.
fn output4(line: &[u8]) -> bool {
    let format = line.windows(3).any(|part| part == b"1P,");
    let blanks = line.iter().take_while(|byte| **byte == b' ').count();
    format && line.get(blanks).is_some_and(u8::is_ascii_digit) && !line.contains(&b'(')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_kinds_are_known_by_their_first_bytes() {
        let cases: [(&[u8], &str); 9] = [
            (b"\xff\xfe1\0 \0", "UTF-16"),
            (b"     100     100       6       2KAA     1P,3E23.16\n       1       1", "OUTPUT4 of Nastran"),
            (b"       3      -3       2       2KAAX    1P,5E16.9 \n", "OUTPUT4 of Nastran"),
            (b"\x18\0\0\0\x03\0\0\0\x03\0\0\0", "binary OUTPUT4"),
            (b"\0\0\0\x18\0\0\0\x03", "binary OUTPUT4"),
            (b"PK\x03\x04\x14\0", "ZIP"),
            (b"\x93NUMPY\x01\0", "NumPy"),
            (b"\x89HDF\r\n\x1a\n", "HDF5"),
            (b"ab\0c", "a binary file"),
        ];
        for (head, expected) in cases {
            assert!(recognise(head).is_some_and(|found| found.contains(expected)), "{expected}");
        }
        for text in ["%%MatrixMarket", "1 1 4\n", "(1P,4D20.12)", "DMIG    KAAX", ""] {
            assert_eq!(recognise(text.as_bytes()), None, "{text}");
        }
    }
}
