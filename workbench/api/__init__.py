"""What a Python program uses of the workbench; `import workbench as wb` brings each name when it is used."""
