"""Python side of the fretting contact. `fretting_contact.profile`: profile tables from line scans."""
